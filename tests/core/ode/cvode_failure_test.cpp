#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/ode/cvode.hpp"

namespace drift::cvode_failure_test {
namespace {

using Method = Cvode::Method;

enum class Mode { none, returns_false, nan, inf, throws, stiff, blows_up, bad_jacobian, bad_start };

/// An oscillator that breaks in a chosen way from t = 1 on, counting its calls.
struct Breaking {
  Mode mode = Mode::none;
  long calls = 0;
  long broken = 0;  ///< calls from t = 1 on
  bool operator()(double t, const double* y, double* y_dot) {
    ++calls;
    broken += t >= 1.0;
    y_dot[0] = y[1];
    y_dot[1] = -4.0 * y[0];
    if (t < 1.0) return true;
    switch (mode) {
      case Mode::returns_false:
        return false;
      case Mode::nan:
        y_dot[1] = std::numeric_limits<double>::quiet_NaN();
        break;
      case Mode::inf:
        y_dot[0] = -std::numeric_limits<double>::infinity();
        break;
      case Mode::throws:
        throw std::runtime_error("broken on purpose");
      case Mode::stiff:
        y_dot[0] += 1e7 * std::sin(1e7 * t);
        break;  // needs ~1e8 steps
      case Mode::blows_up:
        y_dot[0] += 1.0 / std::abs(1.5 - t) / std::abs(1.5 - t) * y[0];
        break;
      default:
        break;
    }
    return true;
  }
};
struct BreakingJacobian {
  Mode mode = Mode::none;
  bool operator()(double t, const double*, double* J) const {
    J[1] = -4.0;
    J[2] = 1.0;
    return !(mode == Mode::bad_jacobian && t > 0.0);
  }
};

struct Trace {
  OdeResult end;
  std::vector<double> y;
  long calls = 0, broken = 0, steps = 0;
};

const OdeOptions options{.rel_tol = 1e-9, .abs_tol = 1e-12, .max_steps = 3000};
const double inf = std::numeric_limits<double>::infinity();

Trace run(Cvode& ode, Mode mode) {
  Breaking f{mode};
  BreakingJacobian J{mode};
  ode.system(f, J);
  const std::array y0{mode == Mode::bad_start ? inf : 1.0, 0.0};
  ode.start(0.0, y0.data(), 3.0);
  Trace trace;
  for (int i = 1; i <= 12 && trace.end.ok(); ++i) {
    trace.end = ode.advance(0.25 * i);
    trace.y.insert(trace.y.end(), ode.state().begin(), ode.state().end());
  }
  trace.calls = f.calls;
  trace.broken = f.broken;
  trace.steps = ode.stats().steps;
  return trace;
}

struct Case {
  Mode mode;
  OdeStatus status;
  const char* word;
};
const std::vector<Case> cases{
    {Mode::returns_false, OdeStatus::rhs_failed, "not computable"},
    {Mode::nan, OdeStatus::rhs_nonfinite, "derivative 1 is not finite"},
    {Mode::inf, OdeStatus::rhs_nonfinite, "derivative 0 is not finite"},
    {Mode::throws, OdeStatus::rhs_threw, "broken on purpose"},
    {Mode::stiff, OdeStatus::too_many_steps, "3000 steps"},
    {Mode::bad_start, OdeStatus::rhs_nonfinite, "initial state 0"},
};

class CvodeFailure : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, CvodeFailure, ::testing::Values(Method::adams, Method::bdf),
                         [](const auto& i) { return i.param == Method::adams ? "Adams" : "Bdf"; });

TEST_P(CvodeFailure, IsAValueWithTimeAndCause) {
  for (const Case& c : cases) {
    Cvode ode(GetParam(), 2, options);
    const Trace t = run(ode, c.mode);
    EXPECT_EQ(t.end.status, c.status) << c.word << ": " << name(t.end.status) << " " << t.end.cause;
    EXPECT_NE(t.end.cause.find(c.word), std::string::npos) << t.end.cause;
    EXPECT_GE(t.end.t, c.mode == Mode::bad_start ? 0.0 : 1.0);
    EXPECT_LT(t.end.t, 1.5);
  }
}

TEST_P(CvodeFailure, EndsTheRunAtOnceInsteadOfCreeping) {
  Cvode sound(GetParam(), 2, options);
  const long good = run(sound, Mode::none).calls;
  for (const Case& c : cases) {
    if (c.mode == Mode::stiff) continue;
    Cvode ode(GetParam(), 2, options);
    const Trace t = run(ode, c.mode);
    EXPECT_LT(t.calls, good) << c.word;
    EXPECT_EQ(t.broken, c.mode == Mode::bad_start ? 0 : 1) << c.word;
  }
  Cvode ode(GetParam(), 2, options);
  const Trace t = run(ode, Mode::stiff);
  EXPECT_LE(t.steps, options.max_steps);
  EXPECT_LT(t.calls, 12 * options.max_steps);  // a step has at most 3 corrections and a few retries
}

TEST_P(CvodeFailure, LeavesNoTraceInTheNextRun) {
  Cvode fresh(GetParam(), 2, options);
  const Trace expected = run(fresh, Mode::none);
  ASSERT_TRUE(expected.end.ok());
  Cvode used(GetParam(), 2, options);
  for (const Mode mode : {Mode::returns_false, Mode::nan, Mode::inf, Mode::throws, Mode::stiff,
                          Mode::blows_up, Mode::bad_jacobian, Mode::bad_start}) {
    run(used, mode);
    const Trace again = run(used, Mode::none);
    EXPECT_EQ(again.y, expected.y) << static_cast<int>(mode);  // bit for bit
    EXPECT_EQ(again.calls, expected.calls);
    EXPECT_TRUE(again.end.cause.empty());
  }
}

TEST_P(CvodeFailure, IsRepeatedUntilTheNextStart) {
  Cvode ode(GetParam(), 2, options);
  Breaking f{Mode::nan};
  BreakingJacobian J;
  ode.system(f, J);
  const std::array y0{1.0, 0.0};
  ode.start(0.0, y0.data(), 3.0);
  const OdeResult first = ode.advance(2.0);
  const long calls = f.calls;
  const OdeResult second = ode.advance(3.0);
  EXPECT_EQ(second.status, first.status);
  EXPECT_EQ(second.cause, first.cause);
  EXPECT_EQ(f.calls, calls);
}

TEST_P(CvodeFailure, ASingularityEndsTheRun) {
  Cvode ode(GetParam(), 2, options);
  const Trace t = run(ode, Mode::blows_up);
  EXPECT_FALSE(t.end.ok());
  EXPECT_NEAR(t.end.t, 1.5, 0.1);
  EXPECT_LT(t.calls, 12 * options.max_steps);
}

TEST(Cvode, ABadJacobianIsNamed) {
  Cvode ode(Method::bdf, 2, options);
  EXPECT_EQ(run(ode, Mode::bad_jacobian).end.status, OdeStatus::jacobian_failed);
}

TEST(Cvode, AJumpInTheStateEndsInTooSmallAStep) {
  // The derivative depends on which side of t = 1 the last call was: no step passes the error test.
  long calls = 0;
  auto f = [&](double t, const double*, double* y_dot) {
    y_dot[0] = t > 1.0 ? (++calls % 2 ? 1e12 : -1e12) : 1.0;
    return true;
  };
  Cvode ode(Method::adams, 1, {});
  ode.system(f);
  const double y0 = 0.0;
  ode.start(0.0, &y0, 2.0);
  const OdeResult r = ode.advance(2.0);
  EXPECT_EQ(r.status, OdeStatus::step_too_small) << name(r.status) << r.cause;
  EXPECT_NEAR(r.t, 1.0, 1e-3);
}

TEST(Cvode, ToleranceBeyondDoublePrecisionIsNamed) {
  Breaking f;
  Cvode ode(Method::adams, 2, {.rel_tol = 1e-18, .abs_tol = 1e-30});
  ode.system(f);
  const std::array y0{1.0, 0.5};
  ode.start(0.0, y0.data(), 3.0);
  EXPECT_EQ(ode.advance(3.0).status, OdeStatus::tolerance_too_tight);
}

TEST(Cvode, TheStepBudgetIsRenewedByStart) {
  Breaking f;
  Cvode ode(Method::adams, 2, {.max_steps = 150});
  ode.system(f);
  const std::array y0{1.0, 0.0};
  int outputs = 0;
  ode.start(0.0, y0.data(), 1000.0);
  while (ode.advance(outputs + 1.0).ok() && outputs < 1000) ++outputs;
  EXPECT_GT(outputs, 0);
  EXPECT_LT(outputs, 1000);
  EXPECT_EQ(ode.advance(outputs + 1.0).status, OdeStatus::too_many_steps);
  EXPECT_LE(ode.stats().steps, 150);
  ode.start(0.0, y0.data(), 1.0);
  EXPECT_TRUE(ode.advance(1.0).ok());
}

TEST(Cvode, ASlowRightHandSideIsStoppedAtTheWallTime) {
  auto f = [](double, const double* y, double* y_dot) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return y_dot[0] = std::sin(1e4 * y[0]), true;
  };
  const double limit = 0.3;  // [s]
  Cvode ode(Method::adams, 1, {.wall_limit = limit});
  ode.system(f);
  const double y0 = 1.0;
  const auto begin = std::chrono::steady_clock::now();
  ode.start(0.0, &y0, 1e6);
  const OdeResult r = ode.advance(1e6);
  const double took =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(r.status, OdeStatus::wall_time) << r.cause;
  EXPECT_GE(took, limit);
  EXPECT_LT(took, 1.2 * limit + 0.1);  // R13, with room for a busy machine
}

TEST(Cvode, TheWallClockChangesNothingElse) {
  Cvode with(Method::adams, 2, {.max_steps = 3000, .wall_limit = 1000.0});
  Cvode without(Method::adams, 2, {.max_steps = 3000});
  EXPECT_EQ(run(with, Mode::none).y, run(without, Mode::none).y);
}

}  // namespace
}  // namespace drift::cvode_failure_test
