#pragma once

#include <cstddef>
#include <vector>

#include "core/estimate/strapdown/signals.hpp"

namespace drift::strapdown {

/// A stretch of time in which the case stands still.
struct Dwell {
  std::size_t first = 0, last = 0;  ///< samples first..last, both included
  double start = 0.0, end = 0.0;    ///< [s]
  double quiet = 0.0;               ///< of the whole quiet stretch, its ends too [s]
  Vec3 gyro = Vec3::Zero();         ///< mean gyro output [rad/s]
  Vec3 acc = Vec3::Zero();          ///< mean accelerometer output [g]
  Vec3 gyro_noise = Vec3::Zero();   ///< standard deviation of one sample [rad/s]
  Vec3 acc_noise = Vec3::Zero();    ///< standard deviation of one sample [g]

  double duration() const { return end - start; }
};

/// How dwells are looked for.
struct DwellOptions {
  double static_min = 2.0;  ///< shortest quiet stretch that counts (Dwell::quiet) [s]
  double window = 0.5;      ///< length over which quiet is judged [s]
};

/// The dwells, and the thresholds the recording itself gave.
struct DwellSearch {
  std::vector<Dwell> dwells;
  double gyro_floor = 0.0, acc_floor = 0.0;          ///< spread at rest [rad/s], [g]
  double gyro_threshold = 0.0, acc_threshold = 0.0;  ///< quiet is below both [rad/s], [g]
  double longest_left = 0.0;  ///< of the quiet stretches that are too short [s]
};

/// Finds the stretches of at least `static_min` in which both sensors are quiet. A rest is quiet
/// for a window less than it lasts, half a one at either end; what is kept of it as a dwell is
/// another window shorter.
///
/// The spread of a sensor is the root of the summed variances of its axes over a window. Its
/// threshold splits the logarithms of the spreads of all windows into two classes of the greatest
/// variance between them (Otsu, IEEE Trans. SMC 9, 1979), rest and motion, and is at least three
/// times the floor, their lower quartile: a recording without motion is then one dwell. A sample is
/// quiet if the window around it is quiet in both sensors; a window with a sample that is not
/// measured, or with a gap in time, is not. Of each quiet stretch the longest part within three
/// times its own median spread is kept, so that a slip of the case does not enter the mean of a
/// dwell, and half a window is cut from both ends, where the onset of motion hides. A stretch whose
/// mean rate is away from the median of all by more than the gyro threshold, and 1 deg/s, turns
/// steadily and is no dwell.
DwellSearch find_dwells(const Signals& signals, const DwellOptions& options);

}  // namespace drift::strapdown
