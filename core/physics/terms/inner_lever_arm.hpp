#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The accelerometers of a strapdown unit do not sit in one point. While the case turns, each feels
/// the acceleration of its own place against the point that the turn leaves where it is.
struct InnerLeverArm {
  static constexpr std::string_view key = "inner_lever_arm";
  static constexpr std::string_view title = "lever arms of the accelerometers";
  static constexpr std::string_view equation = "f_i += e_i . (w' x r_i + w x (w x r_i))";
  static constexpr std::string_view source =
      "rigid body: 5 cm at 10 deg/s are 155 ug; they begin and end a turn with more";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr Prior prior = normal(0.0, 5.0);
  static constexpr auto params =
      join(per_axis<"arm_x">("cm"_unit, prior, "place of the accelerometer along x"),
           per_axis<"arm_y">("cm"_unit, prior, "place of the accelerometer along y"),
           per_axis<"arm_z">("cm"_unit, prior, "place of the accelerometer along z"));
  static constexpr Needs needs{.turning = true};

  template <class S>
  static void readout(const Inputs<S>& in, const S* r, ReadoutAssembly<S>& out) {
    if (in.now().turn == nullptr) return;
    const Mat3& arm = in.now().turn->arm;
    for (int i = 0; i < 3; ++i)
      out.acc[i] += r[i] * arm(i, 0) + r[3 + i] * arm(i, 1) + r[6 + i] * arm(i, 2);
  }
};

}  // namespace drift::terms
