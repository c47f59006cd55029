#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::planning {

/// A nominal attitude, as text for `axes` and as what that text says.
struct Attitude {
  std::string axes;
  Mat3 R_lp = Mat3::Identity();
};

/// The same attitude as text, and without what rounding adds. Empty where an axis lies neither
/// along a local one nor half way between two.
std::optional<Attitude> attitude_of(const Mat3& R_lp);

/// The 24 attitudes whose axes lie along the local ones or against them: all headings in steps of
/// 90 deg.
std::vector<Attitude> cardinal_attitudes();

/// Those, and each of them turned by 45 deg about each of its axes (physics.md 3.3): 96 in all.
std::vector<Attitude> all_attitudes();

}  // namespace drift::planning
