#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "core/plan/readout.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/recording.hpp"

namespace drift {

using Mat3X = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// What was measured in each interval of a timeline; NaN where not measured. Shape (3, intervals).
struct Measurements {
  Mat3X acc;     ///< mean specific force [g]
  Mat3X gimbal;  ///< outer, middle, inner at the end of the interval [rad]
};

/// Whether there is a column for every interval of a timeline, and no more: what the estimators
/// demand.
inline bool is_along(const Measurements& measured, const Timeline& timeline) {
  const auto intervals = static_cast<Eigen::Index>(timeline.intervals.size());
  return measured.acc.cols() == intervals && measured.gimbal.cols() == intervals;
}

/// A sample that is to be measured and is no finite number.
struct NonfiniteSample {
  std::size_t interval = 0;
  std::string_view channel;  ///< "acc_z"
  bool of_accelerometer = false;
};
/// The first of what a readout declares, in intervals first .. end - 1.
std::optional<NonfiniteSample> nonfinite_sample(const Measurements& measured,
                                                const Readout& readout, std::size_t first,
                                                std::size_t end);

/// The channels acc_* and gimbal_* of a recording; absent or unread channels are all NaN.
Measurements measurements_of(const Recording& recording, const Readout& readout);

/// A recording of what was measured along a timeline, in the units of core/docs/recording.md.
/// ContractError if there are other columns than intervals.
Recording make_recording(const Timeline& timeline, const Measurements& measured,
                         const Readout& readout);

/// Difference of two angles, in [-pi, pi] [rad].
inline double angle_difference(double a, double b) {
  return std::remainder(a - b, 2.0 * std::numbers::pi);
}

}  // namespace drift
