#include "tests/support/forward_sensitivity.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace drift::forward_sensitivity_test {
namespace {

// y' = (y2, -a y1 - b y2): parameters a, b and the initial value y1(0).
struct Damped {
  double a = 4.0, b = 0.4;
  bool operator()(double, const double* y, double* y_dot) const {
    y_dot[0] = y[1];
    y_dot[1] = -a * y[0] - b * y[1];
    return true;
  }
};
struct DampedSensitivity {
  double a = 4.0, b = 0.4;
  bool operator()(double, const double* y, const double*, const double* S, double* S_dot) const {
    for (int j = 0; j < 3; ++j) {
      const double* s = S + 2 * j;
      S_dot[2 * j] = s[1];
      S_dot[2 * j + 1] = -a * s[0] - b * s[1] - (j == 0 ? y[0] : 0.0) - (j == 1 ? y[1] : 0.0);
    }
    return true;
  }
};

/// y1 in closed form for y(0) = (y0, 0).
double closed_form(double a, double b, double y0, double t) {
  const double d = b / 2.0, w = std::sqrt(a - d * d);
  return y0 * std::exp(-d * t) * (std::cos(w * t) + d / w * std::sin(w * t));
}

TEST(ForwardSensitivity, IsTheDerivativeOfTheClosedForm) {
  Damped f;
  DampedSensitivity fS;
  MatX S0 = MatX::Zero(2, 3);
  S0(0, 2) = 1.0;
  const std::array scale{4.0, 0.4, 1.0};
  const double t = 5.0;
  const auto r =
      integrate_with_sensitivities(f, fS, {}, 0.0, Eigen::Vector2d(1.5, 0.0), S0, scale, t);
  ASSERT_TRUE(r.result.ok()) << r.result.cause;
  EXPECT_EQ(r.result.t, t);
  EXPECT_NEAR(r.y[0], closed_form(f.a, f.b, 1.5, t), 1e-8);
  // Central differences of the closed form: error h^2/6 f''' ~ 1e-9.
  const double h = 1e-5;
  EXPECT_NEAR(r.S(0, 0),
              (closed_form(f.a + h, f.b, 1.5, t) - closed_form(f.a - h, f.b, 1.5, t)) / (2 * h),
              1e-8);
  EXPECT_NEAR(r.S(0, 1),
              (closed_form(f.a, f.b + h, 1.5, t) - closed_form(f.a, f.b - h, 1.5, t)) / (2 * h),
              1e-8);
  EXPECT_NEAR(r.S(0, 2), closed_form(f.a, f.b, 1.0, t), 1e-8);
  EXPECT_GT(r.stats.steps, 10);
}

TEST(ForwardSensitivity, FailuresAreValues) {
  Damped f;
  auto fS = [](double t, const double*, const double*, const double*, double* S_dot) {
    S_dot[0] = S_dot[1] = t > 1.0 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
    return true;
  };
  const std::array scale{1.0};
  const auto r = integrate_with_sensitivities(f, fS, {}, 0.0, Eigen::Vector2d(1.0, 0.0),
                                              MatX::Zero(2, 1), scale, 3.0);
  EXPECT_EQ(r.result.status, OdeStatus::rhs_nonfinite);
  EXPECT_GE(r.result.t, 1.0);
  DampedSensitivity good;
  const std::array three{1.0, 1.0, 1.0};
  const auto few = integrate_with_sensitivities(
      f, good, {.max_steps = 5}, 0.0, Eigen::Vector2d(1.0, 0.0), MatX::Zero(2, 3), three, 3.0);
  EXPECT_EQ(few.result.status, OdeStatus::too_many_steps);
}

}  // namespace
}  // namespace drift::forward_sensitivity_test
