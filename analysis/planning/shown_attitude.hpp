#pragma once

#include <string>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::planning {

/// An attitude as a study file has it.
struct ShownAttitude {
  std::string axes{};                ///< "x=N y=W z=U"; empty: none
  std::vector<std::string> turns{};  ///< of the platform from there, in order: "10 deg about y"
  Mat3 R_lp = Mat3::Identity();      ///< where it was made of one: what they say

  /// Whether it takes fewer words than another.
  bool plainer_than(const ShownAttitude& other) const;
};

/// The attitude R_lp (v_l = R_lp v_p) that gimbal angles show, as it was meant: axes along N, S, W,
/// E, U, D or half way between two of them, where those are no farther than 3 deg and `room`; else
/// the nearest of the axes along them, and turns in steps of half a degree, with much room of 5 deg
/// where one is so near. room: by what R_lp may be off [rad].
ShownAttitude shown_attitude(const Mat3& R_lp, double room);

/// The keys of a position: `axes = "x=N y=W z=U"`, and `turn = "10 deg about y"` if there are
/// turns, with this in front of each = and between the two.
std::string attitude_keys(const ShownAttitude& attitude, const char* before_equals,
                          const char* between);

}  // namespace drift::planning
