#include "core/ode/rk4.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/linalg.hpp"

namespace drift {
namespace {

using Vec2 = Eigen::Vector2d;

/// Depends on t and y, solved by y = (exp(sin t), cos 2t).
struct Problem {
  Vec2 operator()(double t, const Vec2& y) const {
    return {std::cos(t) * y[0] + (y[1] - std::cos(2.0 * t)), -2.0 * std::sin(2.0 * t) * y[0] * std::exp(-std::sin(t))};
  }
  static Vec2 solution(double t) { return {std::exp(std::sin(t)), std::cos(2.0 * t)}; }
};

template <class Step>
double error(const Step& step, int n) {
  const double t1 = 3.0;
  return (integrate_fixed(step, Problem{}, 0.0, Problem::solution(0.0), t1, n) - Problem::solution(t1)).norm();
}

TEST(RungeKutta, TheClassicalMethodIsOfOrderFour) {
  const auto step = [](auto&&... a) { return rk4_step(a...); };
  EXPECT_NEAR(std::log2(error(step, 100) / error(step, 200)), 4.0, 0.15);
}

TEST(RungeKutta, FehlbergsMethodIsOfOrderEight) {
  const auto step = [](auto&&... a) { return rkf8_step(a...); };
  EXPECT_NEAR(std::log2(error(step, 12) / error(step, 24)), 8.0, 0.5);
  EXPECT_LT(error(step, 200), 1e-13);
}

TEST(RungeKutta, FehlbergsTableIsConsistent) {
  double weights = 0.0;
  for (std::size_t s = 0; s < rkf8::stages; ++s) {
    double row = 0.0;
    for (const double a : rkf8::a[s]) row += a;
    EXPECT_NEAR(row, rkf8::c[s], 1e-14) << s;
    weights += rkf8::b[s];
  }
  EXPECT_NEAR(weights, 1.0, 1e-15);
}

}  // namespace
}  // namespace drift
