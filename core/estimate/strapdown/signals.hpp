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

/// Mean of what a sensor (`gyro` or `acc`) reads from sample k - 1 to sample k. Of instants half of
/// each; of means that of sample k, and over rows that are lost before it half of each.
Vec3 mean_between(const Signals& signals, const std::vector<Vec3>& sensor, std::size_t k);

/// Takes the channels time, gyro_x..z and acc_x..z of a recording (core/docs/recording.md).
/// An empty cell whose neighbours in its channel are measured and no longest_step apart is bridged
/// by the line between them, as the row would be if it were lost; more in a row stay not measured.
/// InputError (recording) lists every channel that is missing or has another dimension, and time
/// that does not increase.
Signals signals_of(const Recording& recording);

}  // namespace drift::strapdown
