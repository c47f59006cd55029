#pragma once

#include <vector>

#include "core/base/units.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// Up to these, two rows were commanded alike and the case turned alike.
inline constexpr double same_command = 1e-9;                  ///< [rad/s]
inline constexpr double same_heading = detail::deg / 3600.0;  ///< [rad]

/// How far the rows of a recording are from each other.
struct RowSpacing {
  std::vector<double> step;  ///< since the row before [s]; NaN for the first
  /// What is usual around the row [s]: the median of the steps of the nearest rows of the same
  /// position and phase, so that rows 1 s apart in slews and 60 s apart in dwells are both usual.
  /// Where those steps are unevenly one to a few of the phase's usual one, rows are lost, half of
  /// them or more, and that one is usual (of a recording that names positions). A stretch of eight
  /// rows or fewer is like the others of its phase, in seconds or in samples of the plan, or by its
  /// own steps where those are alike and, if there is a plan, as planned. NaN where the recording
  /// does not tell.
  std::vector<double> usual;

  /// So many seconds without a row are more than what is usual: halfway to one missing row.
  static bool lost_within(double seconds, double usual) { return seconds > 1.5 * usual; }
  /// Rows are missing in front of this one. (At the first row of a position, time may also have
  /// passed because the platform was caged.)
  bool gap(std::size_t row) const { return lost_within(step[row], usual[row]); }
  /// The way from the row before is longer than what is usual here by half of what is usual on
  /// either side: between seconds and minutes one second may be missing that is no gap by itself.
  bool longer(std::size_t row) const;
  /// Rows that are missing in front of one behind a gap, counted in the longer steps where those on
  /// both sides differ.
  double missing(std::size_t row) const;
  /// Every row is as far from the one before as is usual everywhere within a position, to a
  /// thousandth.
  bool regular = true;
  double shortest = 0.0, longest = 0.0;  ///< of what is usual [s]
  double jitter = 0.0;  ///< rms deviation of the steps from what is usual, gaps left out [s]
};

/// `planned`: sample of the plan at each row [s] (planned_samples()); empty: no plan is known.
RowSpacing row_spacing(const Recording& recording, const std::vector<double>& planned = {});

}  // namespace drift
