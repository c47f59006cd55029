#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/physics/earth.hpp"
#include "core/plan/test_plan.hpp"

namespace drift {

/// Attitude of a platform that starts at R_lp and obeys a constant command exactly, tau [s] later:
/// exp(-w_ie tau) R_lp exp(w_cmd tau).
inline Mat3 reference_attitude(const Site& site, const Mat3& R_lp, const Vec3& omega_cmd_p,
                               double tau) {
  return rotation<double>(-site.omega_ie_l() * tau) * R_lp * rotation<double>(omega_cmd_p * tau);
}

/// A stretch of a test with one command and one turntable rate.
struct Stretch {
  double duration = 0.0;                  ///< [s]
  Vec3 omega_cmd_p = Vec3::Zero();        ///< [rad/s]
  bool slew = false;                      ///< on the way, not dwelling
  double heading0 = 0.0, heading1 = 0.0;  ///< of the case [rad]
};

/// How a position is reached and held.
struct Passage {
  bool caged = false;
  std::vector<Stretch> approach;  ///< turn of the case, then slew; each only if needed
  Stretch dwell;
};

/// Largest angle of the middle gimbal that a plan may use.
inline constexpr double middle_gimbal_limit = 60.0 * detail::deg;  // [rad]

/// Largest heading that a plan may ask for, either way: a hundred turns.
inline constexpr double most_case_heading_deg = 36000.0;

/// No heading of the case keeps the middle gimbal of a position where it can be used.
class GimbalLock : public InputError {
 public:
  GimbalLock(std::size_t at, std::string why)
      : InputError(ExitCode::config, "plan: " + why), position(at), text(std::move(why)) {}

  std::size_t position;  ///< from 0
  std::string text;      ///< what, and what to do
};

/// Commands, durations and case headings of every position of a plan. Approaches last a whole
/// number of samples. A heading that the plan leaves open stays as it is while the middle gimbal
/// stays below the limit on the way and in the dwell; otherwise the case is turned (before the
/// slew) to the nearest multiple of 15 deg that keeps it. GimbalLock if there is none.
std::vector<Passage> plan_passages(const TestPlan& plan, const Site& site);

}  // namespace drift
