#include "core/ode/cvode.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace drift::cvode_test {
namespace {

using Method = Cvode::Method;

/// y'' = -w^2 y as two states; y(0) = (1, 0) gives (cos wt, -w sin wt).
struct Oscillator {
  double w = 2.0;
  bool operator()(double, const double* y, double* y_dot) const {
    y_dot[0] = y[1];
    y_dot[1] = -w * w * y[0];
    return true;
  }
};
struct OscillatorJacobian {
  double w = 2.0;
  bool operator()(double, const double*, double* J) const {
    J[1] = -w * w;  // d y_dot[1] / d y[0]: column-major
    J[2] = 1.0;
    return true;
  }
};

class CvodeBoth : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, CvodeBoth, ::testing::Values(Method::adams, Method::bdf),
                         [](const auto& i) { return i.param == Method::adams ? "Adams" : "Bdf"; });

double oscillator_error(Method method, double tolerance, double t_end) {
  Oscillator f;
  OscillatorJacobian J;
  Cvode ode(method, 2, {.rel_tol = tolerance, .abs_tol = tolerance});
  ode.system(f, J);
  const std::array y0{1.0, 0.0};
  ode.start(0.0, y0.data(), t_end);
  EXPECT_TRUE(ode.advance(t_end).ok());
  return std::hypot(ode.state()[0] - std::cos(f.w * t_end),
                    ode.state()[1] + f.w * std::sin(f.w * t_end));
}

TEST_P(CvodeBoth, TheErrorOfAnOscillatorFollowsTheTolerance) {
  // Local errors below the tolerance add up over ~100 steps per radian at most.
  double before = 1.0;
  for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
    const double error = oscillator_error(GetParam(), tolerance, 10.0);
    EXPECT_LT(error, 2000.0 * tolerance) << tolerance;
    EXPECT_LT(error, 0.2 * before) << tolerance;
    before = error;
  }
}

TEST_P(CvodeBoth, LinearDecayIsMetAtEveryNode) {
  const double k = 0.3;
  auto f = [&](double, const double* y, double* y_dot) { return y_dot[0] = -k * y[0], true; };
  auto J = [&](double, const double*, double* j) { return j[0] = -k, true; };
  Cvode ode(GetParam(), 1, {.rel_tol = 1e-10, .abs_tol = 1e-14});
  ode.system(f, J);
  const double y0 = 5.0;
  ode.start(100.0, &y0, 120.0);
  for (double t = 100.0; t <= 120.0; t += 0.37) {
    const OdeResult r = ode.advance(t);
    ASSERT_TRUE(r.ok()) << r.cause;
    EXPECT_EQ(r.t, t);
    EXPECT_TRUE(r.cause.empty());
    EXPECT_NEAR(ode.state()[0], 5.0 * std::exp(-k * (t - 100.0)), 1e-7);
  }
  EXPECT_GT(ode.stats().steps, 10);
  EXPECT_GE(ode.stats().rhs_calls, ode.stats().steps);
}

TEST(Cvode, BdfFollowsTheSlowSolutionOfAProtheroRobinsonProblem) {
  // y' = L (y - g) + g', solved by g = sin t; L = -1e6 leaves explicit steps no more than 2e-6.
  const double L = -1e6;
  auto f = [&](double t, const double* y, double* y_dot) {
    return y_dot[0] = L * (y[0] - std::sin(t)) + std::cos(t), true;
  };
  auto J = [&](double, const double*, double* j) { return j[0] = L, true; };
  Cvode ode(Method::bdf, 1, {.rel_tol = 1e-9, .abs_tol = 1e-11});
  ode.system(f, J);
  const double y0 = 0.0;
  ode.start(0.0, &y0, 10.0);
  ASSERT_TRUE(ode.advance(10.0).ok());
  EXPECT_NEAR(ode.state()[0], std::sin(10.0), 1e-7);
  EXPECT_LT(ode.stats().steps, 2000);
  EXPECT_GT(ode.stats().jacobian_calls, 0);
  EXPECT_LT(ode.stats().jacobian_calls, ode.stats().steps);
}

TEST_P(CvodeBoth, TheRightHandSideIsNeverCalledBeyondTheStop) {
  // 0.1 + 0.7 rounds up: local time must not pass the stop either.
  for (const auto& span : {std::pair{0.0, 1.0}, {0.1, 0.1 + 0.7}, {1e6 / 3.0, 1e6 / 3.0 + 0.3}}) {
    const double t0 = span.first, t_stop = span.second;
    double latest = t0;
    long beyond = 0;
    auto f = [&](double t, const double* y, double* y_dot) {
      latest = std::max(latest, t);
      beyond += t > t_stop;
      y_dot[0] = t > t_stop ? 1e9 : -y[0];  // a jump right behind the stop
      return true;
    };
    auto J = [](double, const double*, double* j) { return j[0] = -1.0, true; };
    Cvode ode(GetParam(), 1, {});
    ode.system(f, J);
    const double y0 = 1.0;
    ode.start(t0, &y0, t_stop);
    for (int i = 1; i <= 4; ++i) ASSERT_TRUE(ode.advance(t0 + 0.25 * i * (t_stop - t0)).ok());
    const OdeResult r = ode.advance(t_stop + 5.0);  // asks for more than there is
    EXPECT_TRUE(r.ok());
    EXPECT_EQ(r.t, t_stop);
    EXPECT_EQ(beyond, 0) << t_stop;
    EXPECT_GT(latest, t_stop - 1e-3);
    EXPECT_NEAR(ode.state()[0], std::exp(t0 - t_stop), 1e-8);
  }
}

TEST_P(CvodeBoth, SegmentsBehindADiscontinuityAreStartedAgain) {
  double rate = 0.0;
  auto f = [&](double, const double*, double* y_dot) { return y_dot[0] = rate, true; };
  auto J = [](double, const double*, double* j) { return j[0] = 0.0, true; };
  Cvode ode(GetParam(), 1, {});
  ode.system(f, J);
  double y = 0.0;
  ode.start(0.0, &y, 0.0);  // a segment of no length is no error
  EXPECT_TRUE(ode.advance(0.0).ok());
  double expected = 0.0;
  for (int segment = 0; segment < 5; ++segment) {
    rate = segment % 2 ? -3.0 : 7.0;
    ode.start(segment, &y, segment + 1.0, 1e-3);
    ASSERT_TRUE(ode.advance(segment + 1.0).ok());
    y = ode.state()[0];
    expected += rate;
    EXPECT_NEAR(y, expected, 1e-9);
  }
}

TEST(Cvode, EveryStateHasItsOwnAbsoluteTolerance) {
  // Two free oscillators, the second followed loosely: only its error may be large.
  auto f = [](double, const double* y, double* y_dot) {
    for (int i : {0, 2}) y_dot[i] = y[i + 1], y_dot[i + 1] = -y[i];
    return true;
  };
  const std::array y0{1e-3, 0.0, 1e-3, 0.0};
  const auto steps = [&](std::array<double, 4> tolerance) {
    Cvode ode(Method::adams, {.rel_tol = 1e-14}, tolerance);
    ode.system(f);
    ode.start(0.0, y0.data(), 20.0);
    EXPECT_TRUE(ode.advance(20.0).ok());
    return ode.stats().steps;
  };
  const long tight = steps({1e-12, 1e-12, 1e-12, 1e-12}), mixed = steps({1e-12, 1e-12, 1e-4, 1e-4});
  const long loose = steps({1e-5, 1e-5, 1e-5, 1e-5});
  EXPECT_LT(std::abs(tight - mixed), tight / 3);
  EXPECT_LT(2 * loose, mixed);
}

TEST(Cvode, TheLongestStepIsKept) {
  Oscillator f{1e-6};
  Cvode ode(Method::adams, 2, {.max_step = 0.01});
  ode.system(f);
  const std::array y0{1.0, 0.0};
  ode.start(0.0, y0.data(), 1.0);
  ASSERT_TRUE(ode.advance(1.0).ok());
  EXPECT_GE(ode.stats().steps, 100);
}

TEST(Cvode, CanBeMoved) {
  Oscillator f;
  const std::array y0{1.0, 0.0};
  Cvode a(Method::adams, 2, {});
  a.system(f);
  a.start(0.0, y0.data(), 2.0);
  ASSERT_TRUE(a.advance(1.0).ok());
  Cvode b = std::move(a);
  ASSERT_TRUE(b.advance(2.0).ok());
  EXPECT_NEAR(b.state()[0], std::cos(4.0), 1e-8);
  EXPECT_EQ(b.size(), 2);
}

}  // namespace
}  // namespace drift::cvode_test
