#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Random walk of the fixed drift of each gyro, beside the study's own `drift_random_walk` for all
/// three. Drives the truth; in the EKF it is process noise of D_F, which must be estimated then.
/// The batch fit does not model it.
struct DriftRandomWalk {
  static constexpr std::string_view key = "drift_random_walk";
  static constexpr std::string_view title = "random walk of the fixed drift";
  static constexpr std::string_view equation = "d(D_F_i) = q_i dW_i";
  static constexpr std::string_view source =
      "physics.md 4, no. 8: 0.001 to 0.005 deg/h per sqrt(h)";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params = per_axis<"q">(unit::deg_per_h_per_sqrt_h, uniform(0.001, 0.005),
                                               "random walk of D_F", ParamKind::noise);
};

}  // namespace drift::terms
