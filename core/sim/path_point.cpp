#include "core/sim/path_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plan/case_heading.hpp"
#include "core/sim/measurements.hpp"

namespace drift {
namespace {

/// Where a rate that changes its sign is zero, of a step of length 1: by its ends and its integral,
/// which make a parabola of it. And the integral until then.
std::pair<double, double> reversal(double begin, double end, double integral) {
  const double b = 6.0 * integral - 4.0 * begin - 2.0 * end,
               c = 3.0 * (begin + end) - 6.0 * integral;
  const double falling = begin > 0.0 ? -b : b;
  const double s = 2.0 * std::abs(begin) / (falling + std::sqrt(b * b - 4.0 * begin * c));
  return {s, s * (begin + s * (0.5 * b + s * c / 3.0))};
}

}  // namespace

PathPoint path_point(const Mat3& R_lp, double heading, const Interval& interval,
                     const Vec3& omega_ic_l, bool gimbals) {
  PathPoint p;
  p.f_p = R_lp.row(2);
  if (!gimbals) return p;
  p.gimbal = gimbal_angles<double>(case_attitude(heading).transpose() * R_lp);
  p.gimbal_rate =
      gimbal_rates<double>(p.gimbal, interval.omega_cmd_p - R_lp.transpose() * omega_ic_l);
  return p;
}

PathStep between(const PathPoint& a, const PathPoint& b, double dt, const Vec3& omega_cmd_p) {
  PathStep step{dt, a.f_p, b.f_p, omega_cmd_p};
  for (int k = 0; k < 3; ++k) {
    step.turned[k] = angle_difference(b.gimbal[k], a.gimbal[k]);
    const double begin = a.gimbal_rate[k] * dt, end = b.gimbal_rate[k] * dt;
    double until = 1.0;
    if (begin * end < 0.0) {
      const auto [part, there] = reversal(begin, end, step.turned[k]);
      const double back = step.turned[k] - there;
      if (there * begin > 0.0 && back * end > 0.0) {
        step.turned[k] = there;
        step.turned_back[k] = back;
        step.until_reversal[k] = until = part;
      }
    }
    if (step.turned[k] != 0.0 && dt > 0.0)
      step.begin_rate[k] = std::clamp(begin * until / step.turned[k], 0.0, 2.0);
  }
  return step;
}

}  // namespace drift
