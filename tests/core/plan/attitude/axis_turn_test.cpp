// Turns of the platform about its own axes, behind the letters of `axes`.
#include "core/plan/attitude/axis_turn.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/check.hpp"
#include "core/physics/gimbals.hpp"
#include "core/plan/case_heading.hpp"
#include "tests/support/plan_text.hpp"

namespace drift::axis_turn_test {
namespace {

constexpr double deg = detail::deg;

/// A position that lies level, x to the North, with such a `turn`.
std::string level(const std::string& turn, const std::string& more = "") {
  return "[[plan.position]]\nname = \"a\"\naxes = \"x=N y=W z=U\"\nturn = " + turn + "\n" + more;
}

Position turned(const std::string& turn) {
  const test::PlanRead r = test::read_plan_text(level(turn));
  EXPECT_TRUE(r.mistakes.empty()) << turn << ": " << r.mistakes.front();
  return r.config.plan.positions.at(0);
}

Mat3 of_axes(const char* text) {
  std::string why;
  return parse_axes(text, why).value();
}

/// Specific force [g]: Up, in platform axes.
Vec3 force(const Position& p) {
  return p.R_lp.row(2);
}

TEST(AxisTurn, TurnsThePlatformRightHandedAboutItsOwnAxis) {
  // Right-handed about y, z goes toward x and x away from z: x now points along cos x - sin z, that
  // is to 30 deg below North, and reads -sin 30 of Up; z, along cos z + sin x, reads cos 30.
  const Position p = turned("\"30 deg about y\"");
  EXPECT_LT((force(p) - Vec3(-0.5, 0.0, std::sqrt(0.75))).norm(), 1e-15);
  // x points to N cos 30 - U sin 30, y to West as before.
  EXPECT_LT((p.R_lp.col(0) - Vec3(std::sqrt(0.75), 0.0, -0.5)).norm(), 1e-15);
  EXPECT_LT((p.R_lp.col(1) - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(p.axes, "x=N y=W z=U");
  EXPECT_EQ(attitude_text(p), "x=N y=W z=U, 30 deg about y");
  // About the vertical nothing is seen of it but the heading: x from North toward West.
  const Position about_up = turned("\"30 deg about z\"");
  EXPECT_LT((force(about_up) - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((about_up.R_lp.col(0) - Vec3(std::sqrt(0.75), 0.5, 0.0)).norm(), 1e-15);
}

TEST(AxisTurn, OfSeveralEachIsAboutTheAxisAsTheLastLeftIt) {
  // 30 deg about y: f = (-s30, 0, c30). Then x stays where it is, and y rises toward z, by 20 deg.
  const double s30 = 0.5, c30 = std::sqrt(0.75), s20 = std::sin(20.0 * deg),
               c20 = std::cos(20.0 * deg);
  const Position p = turned("[\"30 deg about y\", \"20 deg about x\"]");
  EXPECT_LT((force(p) - Vec3(-s30, s20 * c30, c20 * c30)).norm(), 1e-15);
  // The other way round: f = (0, s20, c20), and then x sinks from level.
  const Position other = turned("[\"20 deg about x\", \"30 deg about y\"]");
  EXPECT_LT((force(other) - Vec3(-s30 * c20, s20, c30 * c20)).norm(), 1e-15);
  // Two about one axis are one.
  EXPECT_LT(
      (turned("[\"10 deg about y\", \"20 deg about y\"]").R_lp - turned("\"30 deg about y\"").R_lp)
          .norm(),
      1e-15);
  EXPECT_EQ(attitude_text(p), "x=N y=W z=U, 30 deg about y, 20 deg about x");
}

TEST(AxisTurn, OfQuarterTurnsTheAttitudeIsThatOfTheLetters) {
  EXPECT_EQ(turned("\"90 deg about y\"").R_lp, of_axes("x=D y=W z=N"));
  EXPECT_EQ(turned("\"90 deg about x\"").R_lp, of_axes("x=N y=U z=E"));
  EXPECT_EQ(turned("\"90 deg about z\"").R_lp, of_axes("x=W y=S z=U"));
  EXPECT_EQ(turned("\"-90 deg about y\"").R_lp, of_axes("x=U y=W z=S"));
  EXPECT_EQ(turned("\"0.5 turn about y\"").R_lp, of_axes("x=S y=W z=D"));
  EXPECT_EQ(turned("[\"270 deg about y\", \"360 deg about x\"]").R_lp, of_axes("x=U y=W z=S"));
  EXPECT_LT((turned("\"45 deg about y\"").R_lp - of_axes("x=ND y=W z=UN")).norm(), 1e-15);
}

TEST(AxisTurn, TakesAnyUnitOfAnglesAndBlanks) {
  const Mat3 R = turned("\"10 deg about y\"").R_lp;
  for (const char* turn : {"\"600 arcmin about y\"", "\" 10deg  about\\ty \"",
                           "[\"10 deg about y\"]", "\"0.17453292519943295 rad about y\""})
    EXPECT_LT((turned(turn).R_lp - R).norm(), 1e-15) << turn;
  EXPECT_EQ(turned("\" +10deg  about\\ty \"").turns.at(0).text, "+10deg about y");
}

struct Mistake {
  const char* turn;
  const char* at;  ///< "line:column"
  std::vector<std::string> says;
};

TEST(AxisTurn, MistakesAreSaidWhereTheyStand) {
  const Mistake mistakes[] = {
      {"\"10 deg\"", "5:8", {"'plan.position.a.turn' = \"10 deg\" names no axis", "Add about x"}},
      {"\"10 deg about\"", "5:8", {"names no axis", "\"10 deg about y\""}},
      {"\"10 deg about w\"",
       "5:8",
       {"turns about 'w' (expected x, y or z, an axis of the platform"}},
      {"\"10 deg about Y\"", "5:8", {"turns about 'Y'", "Did you mean 'y'?"}},
      {"\"10 deg about y axis\"", "5:8", {"turns about 'y axis'", "Name x, y or z"}},
      {"\"10 about y\"", "5:8", {"'plan.position.a.turn' = \"10\" has no unit", "\"10 deg\""}},
      {"\"about y\"", "5:8", {"has no number"}},
      {"\"10 s about y\"", "5:8", {"has the unit 's', which measures something else", "'deg'"}},
      {"\"10 degs about y\"", "5:8", {"unknown unit 'degs'", "Did you mean 'deg'?"}},
      {"\"400 deg about y\"", "5:8", {"out of range (expected -360 deg to 360 deg)"}},
      {"10", "5:8", {"is the number 10", "Write turn = \"10 deg about y\""}},
      {"[]", "5:8", {"is the list []", "or a list of turns, done one after the other"}},
      {"[\"10 deg about y\", \"5 deg\"]", "5:27", {"\"5 deg\" names no axis"}},
      {"[\"10 deg about y\", 5]", "5:27", {"is the number 5"}},
      {"[[\"10 deg about y\"]]", "5:9", {"is the list"}},
  };
  for (const Mistake& m : mistakes) {
    const auto said = test::read_plan_text(level(m.turn)).mistakes;
    ASSERT_EQ(said.size(), 1u) << m.turn;
    EXPECT_TRUE(said[0].starts_with(std::string("t.toml:") + m.at + ":")) << said[0];
    for (const std::string& part : m.says)
      EXPECT_NE(said[0].find(part), std::string::npos) << part << " | " << said[0];
  }
  EXPECT_EQ(test::read_plan_text(level("\"10 about w\"")).mistakes.size(), 2u);
}

TEST(AxisTurn, GimbalsCommandsAndSlewsAreThoseOfTheTurnedPlatform) {
  const Site site{.latitude = 45.0 * deg};
  const auto plan = [](const std::string& text) {
    return test::read_plan_text("dwell = \"10 min\"\nmode = \"level\"\n" + text).config.plan;
  };
  const TestPlan tilted = plan(level("\"30 deg about y\"") +
                               "[[plan.position]]\nname = \"b\"\naxes = \"x=N y=W z=U\"\n"
                               "turn = \"70 deg about y\"\nentry = \"torqued\"\n");
  const std::vector<Passage> way = plan_passages(tilted, site);
  // In a case that heads North, y is the axis of the middle gimbal.
  EXPECT_EQ(way[0].dwell.heading0, 0.0);
  EXPECT_LT((gimbal_angles<double>(tilted.positions[0].R_lp) - Vec3(0.0, 30.0 * deg, 0.0)).norm(),
            1e-14);
  // Level, the Earth rate is commanded: North and Up of it, in axes that are 30 deg below North and
  // as much North of Up.
  const double north = site.omega_ie_l().x(), up = site.omega_ie_l().z(), c = std::sqrt(0.75);
  EXPECT_LT(
      (way[0].dwell.omega_cmd_p - Vec3(c * north - 0.5 * up, 0.0, 0.5 * north + c * up)).norm(),
      1e-18);
  // At 70 deg the middle gimbal would be beyond its limit: the case is turned, to the nearest
  // heading h that keeps sin(70) cos(h) below sin(60).
  EXPECT_DOUBLE_EQ(std::abs(way[1].dwell.heading0), 30.0 * deg);
  ASSERT_EQ(way[1].approach.size(), 2u);
  // The slew: 40 deg about y, at half a degree a second, beside what the Earth turns meanwhile.
  const Stretch& slew = way[1].approach[1];
  EXPECT_DOUBLE_EQ(slew.duration, 120.0);
  EXPECT_LT((slew.duration * slew.omega_cmd_p - Vec3(0.0, 40.0 * deg, 0.0)).norm(),
            1.05 * detail::earth_rate * slew.duration);

  const TestPlan singular = plan(level("\"90 deg about y\"", "case_heading = \"0 deg\"\n"));
  try {
    plan_passages(singular, site);
    ADD_FAILURE() << "the middle gimbal stands at 90 deg";
  } catch (const GimbalLock& lock) {
    EXPECT_NE(lock.text.find("the middle gimbal would reach 90 deg"), std::string::npos)
        << lock.text;
  }
  EXPECT_EQ(plan_passages(plan(level("\"90 deg about y\"")), site).size(), 1u)
      << "the case is turned";
}

}  // namespace
}  // namespace drift::axis_turn_test
