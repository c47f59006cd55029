// What a study says of an attitude that gimbals show, read back by the reader of plans.
#include "analysis/planning/shown_attitude.hpp"

#include <gtest/gtest.h>

#include "analysis/planning/attitudes.hpp"
#include "tests/support/plan_text.hpp"

namespace drift::shown_attitude_test {
namespace {

using planning::ShownAttitude;

constexpr double deg = detail::deg;
/// By what a platform is off [rad].
const Vec3 off(0.1 * deg, -0.15 * deg, 0.2 * deg);

Mat3 read_back(const ShownAttitude& shown) {
  const test::PlanRead r = test::read_plan_text("[[plan.position]]\n" +
                                                planning::attitude_keys(shown, " ", "\n") + "\n");
  EXPECT_TRUE(r.mistakes.empty()) << r.mistakes.front();
  return r.config.plan.positions.at(0).R_lp;
}

double apart(const Mat3& a, const Mat3& b) {
  return rotation_vector(Mat3(a.transpose() * b)).norm();
}

Mat3 about(int axis, double degrees) {
  return rotation<double>(degrees * deg * Vec3::Unit(axis));
}

TEST(ShownAttitude, AlongDirectionsOrHalfWayNeedsNoTurn) {
  for (const planning::Attitude& a : planning::all_attitudes()) {
    const ShownAttitude shown = planning::shown_attitude(a.R_lp * rotation<double>(off), 0.0);
    EXPECT_TRUE(shown.turns.empty()) << a.axes;
    EXPECT_LT(apart(read_back(shown), a.R_lp), 1e-14) << a.axes;
  }
}

TEST(ShownAttitude, OfATumbleIsThatOfItsStep) {
  for (const planning::Attitude& a : planning::cardinal_attitudes())
    for (int axis = 0; axis < 3; ++axis)
      for (const double step : {10.0, 15.0, 22.5, 36.0, 40.0})
        for (double angle = step; angle < 360.0; angle += step) {
          const Mat3 meant = a.R_lp * about(axis, angle);
          const ShownAttitude shown = planning::shown_attitude(meant * rotation<double>(off), 0.0);
          EXPECT_LE(shown.turns.size(), 1u) << a.axes << angle;
          EXPECT_LT(apart(read_back(shown), meant), 1e-14) << a.axes << angle;
        }
}

TEST(ShownAttitude, OfSeveralTurnsHasThemInOrder) {
  const Mat3 meant = about(0, 20.0) * about(1, -30.0) * about(2, 12.5);
  const ShownAttitude shown = planning::shown_attitude(meant, 0.0);
  EXPECT_EQ(planning::attitude_keys(shown, " ", ", "),
            "axes = \"x=N y=W z=U\", turn = [\"20 deg about x\", \"-30 deg about y\", \"12.5 deg "
            "about z\"]");
  EXPECT_LT(apart(read_back(shown), meant), 1e-14);
  // Known to half a degree alone, steps of 5 deg are likelier than others.
  EXPECT_EQ(planning::shown_attitude(about(1, 30.6), 0.5 * deg).turns.at(0), "30 deg about y");
  EXPECT_EQ(planning::shown_attitude(about(1, 32.1), 0.5 * deg).turns.at(0), "32 deg about y");
  // Whatever it is, no attitude is farther away than the steps.
  for (int k = 1; k < 200; ++k) {
    const Mat3 R = rotation<double>(Vec3(0.1 * k, 1.3 * std::sin(k), std::cos(2.7 * k)));
    EXPECT_LT(apart(read_back(planning::shown_attitude(R, 0.0)), R), 3.0 * deg) << k;
  }
}

TEST(ShownAttitude, StepsOfAFewDegreesAreNoTurnsWhereTheyMayBeOtherwise) {
  const Mat3 R = about(1, 7.0);
  EXPECT_EQ(planning::attitude_keys(planning::shown_attitude(R, 0.0), " ", ", "),
            "axes = \"x=N y=W z=U\", turn = \"7 deg about y\"");
  EXPECT_EQ(planning::attitude_keys(planning::shown_attitude(R, 10.0 * deg), "  ", "\n"),
            "axes  = \"x=N y=W z=U\"");
}

}  // namespace
}  // namespace drift::shown_attitude_test
