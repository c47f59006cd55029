#pragma once

#include <vector>

#include "core/base/linalg.hpp"
#include "core/recording/recording.hpp"

namespace drift::strapdown {

/// Samples farther apart than so many intervals have a gap between them: one lost row is bridged,
/// two in a row are not.
inline constexpr double longest_step = 2.5;

/// The samples of a strapdown recording: sensors fixed to the case, as they were read.
struct Signals {
  std::vector<double> time;  ///< end of each sample interval [s]
  std::vector<Vec3> gyro;    ///< gyro outputs w_g [rad/s]; NaN: not measured
  std::vector<Vec3> acc;     ///< accelerometer outputs [g]; NaN: not measured
  double interval = 0.0;     ///< usual sample interval, the median [s]
  /// Whether what was read is the mean over covered(k), angles and velocities gained once divided
  /// by their intervals; else what is at time[k] (holds_mean_rates()).
  bool means = false;

  std::size_t size() const { return time.size(); }
  bool measured(std::size_t k) const { return gyro[k].allFinite() && acc[k].allFinite(); }
  /// Time up to time[k] over which sample k is the mean, if it is one: since the sample before, the
  /// usual interval where rows are lost between them [s].
  double covered(std::size_t k) const;
};

/// Mean of what a sensor (`gyro` or `acc`) reads from sample k - 1 to sample k. Of means that of
/// sample k, and over rows that are lost before it half of each. Of instants the mean of the cubic
/// through the four about the interval, at their times; evenly spaced
///
///   (-w_(k-2) + 13 w_(k-1) + 13 w_k - w_(k+1)) / 24.
///
/// Where one of the outer two was not measured or lies behind a gap, or its step is much shorter
/// than the interval, the parabola through three; without both the line, half of each.
///
/// Over a row of samples these sum up to one of each inside it, as the trapezoid does, and to 1/2
/// and 25/24 of its first two (of the trapezoid 1/2 and 1), -1/24 of that before: noise that is
/// white adds up over rows to the same random walk, which goes with their length.
Vec3 mean_between(const Signals& signals, const std::vector<Vec3>& sensor, std::size_t k);

/// Takes the channels time, gyro_x..z and acc_x..z of a recording (core/docs/recording.md).
/// An empty cell whose neighbours in its channel are measured and no longest_step apart is bridged
/// by the line between them, as the row would be if it were lost; more in a row stay not measured.
/// InputError (recording) lists every channel that is missing or has another dimension, and time
/// that does not increase.
Signals signals_of(const Recording& recording);

}  // namespace drift::strapdown
