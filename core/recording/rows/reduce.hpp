#pragma once

#include <cstddef>
#include <optional>

#include "core/recording/recording.hpp"

namespace drift {

/// Sample intervals of a recording.
struct SampleIntervals {
  double typical = 0.0;            ///< median within positions [s]; NaN if no position has two rows
  double shortest_position = 0.0;  ///< shortest time that a position lasts [s]
};
SampleIntervals sample_intervals(const Recording& recording);

/// Which gimbal angles a stretch has.
enum class Angles { at_the_end, around_the_end };

/// The recording with stretches of `factor` samples of `interval` seconds each made into one.
///
/// Accelerometers: mean over the stretch. A stretch that holds at least half of its samples is
/// bridged by the straight line through them (exact to |f''| T^2 / 24: below 1 ug for a platform
/// that turns at Earth rate and T <= 60 s); with less it is not measured. Gimbal angles and case
/// heading: as read at the end of the stretch; not measured if that row is missing. Covariates are
/// what they are at its end, too: line_at_end().
/// `reading` above 0: every so many rows are one reading of the angles of which the readout's noise
/// is declared, and where stretches of five such readings and more follow each other without a cut,
/// angles are those that the readings around the end show (AnglesAround; `readings`: how many they
/// are worth).
/// Commands: mean, and a stretch ends where they change by more than 1e-9 rad/s, where phase or
/// position changes and where the case heading leaves its straight line by more than an arcsecond.
/// The stretches of a position begin one sample before its first row; rows keep their time.
/// `begins` and `samples` are set: a stretch that is cut off early averages less noise away.
Recording reduced(const Recording& recording, double interval, std::size_t factor,
                  std::size_t reading = 0);

}  // namespace drift
