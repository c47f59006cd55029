#include "core/plan/timeline.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/base/check.hpp"
#include "core/physics/gimbals.hpp"
#include "core/plan/case_heading.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::timeline_test {
namespace {

using namespace drift::test;

TEST(Axes, DirectionsAndTheirMistakes) {
  std::string why;
  const auto R = parse_axes("x=N y=UW z=UE", why);
  ASSERT_TRUE(R) << why;
  EXPECT_NEAR(R->determinant(), 1.0, 1e-15);
  EXPECT_NEAR(R->col(2).dot(Vec3::UnitZ()), std::sqrt(0.5), 1e-15);
  for (const char* text : {"", "x=N y=W", "x=N y=W z=D", "x=N y=N z=U", "x=N y=UW z=U",
                           "x=NS y=W z=U", "x=Q y=W z=U", "a=N y=W z=U", "x=N x=N y=W z=U"}) {
    why.clear();
    EXPECT_FALSE(parse_axes(text, why)) << text;
    EXPECT_FALSE(why.empty()) << text;
  }
}

TEST(Axes, OfALeftHandedFrameTheLastIsTurnedRound) {
  for (const auto& [wrong, third] :
       {std::pair{"x=N y=W z=D", "U"}, {"z=WD y=WU x=N", "EU"}, {"x=E y=N z=D", "U"}}) {
    std::string why;
    ASSERT_FALSE(parse_axes(wrong, why)) << wrong;
    ASSERT_TRUE(why.ends_with(std::string(" z points ") + third)) << why;
    std::string text = wrong;
    const auto z = text.find("z=") + 2;
    text.replace(z, text.find_first_of(" ", z) - z, third);
    EXPECT_TRUE(parse_axes(text, why)) << text << ": " << why;
  }
}

TEST(Presets, HoldTheirPositions) {
  const std::map<std::string, std::size_t> sizes{
      {"six", 6},       {"twelve", 12}, {"twentyfour", 24}, {"apollo10", 10},
      {"eighteen", 18}, {"slew12", 12}, {"casespin", 6}};
  EXPECT_EQ(sizes.size(), preset_names.size());
  for (const auto& [name, size] : sizes) {
    const auto plan = preset_plan(name, {});
    ASSERT_TRUE(plan) << name;
    EXPECT_EQ(plan->positions.size(), size) << name;
    EXPECT_EQ(plan->positions.front().entry, Entry::caged);
    for (const Position& p : plan->positions)
      EXPECT_LT((p.R_lp.transpose() * p.R_lp - Mat3::Identity()).norm(), 1e-12)
          << name << " " << p.name;
  }
  EXPECT_FALSE(preset_plan("seven", {}));
}

TEST(Presets, TwentyFourAreTheRotationsOfTheCube) {
  const auto plan = *preset_plan("twentyfour", {});
  for (std::size_t a = 0; a < 24; ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT((plan.positions[a].R_lp - plan.positions[b].R_lp).norm(), 1.0) << a << " " << b;
}

TEST(Presets, SlewTwelveTurnsNinetyDegreesAboutEveryAxisBothWays) {
  const auto plan = *preset_plan("slew12", {});
  std::map<std::pair<int, int>, int> slews;
  for (std::size_t p = 1; p < 12; ++p) {
    const Vec3 v = rotation_vector(plan.positions[p - 1].R_lp.transpose() * plan.positions[p].R_lp);
    EXPECT_NEAR(v.norm(), 90.0 * detail::deg, 1e-12);
    int axis = 0;
    v.cwiseAbs().maxCoeff(&axis);
    EXPECT_NEAR(std::abs(v[axis]), v.norm(), 1e-12);
    ++slews[{axis, v[axis] > 0 ? 1 : -1}];
  }
  EXPECT_EQ(slews.size(), 6u);
}

TEST(GimbalChain, AnglesAndRotationAreInverse) {
  for (std::uint64_t k = 0; k < 20; ++k) {
    Stream s(k, 0, Purpose::test);
    const Vec3 angles(3.0 * (2.0 * s.uniform() - 1.0), 1.5 * (2.0 * s.uniform() - 1.0),
                      3.0 * (2.0 * s.uniform() - 1.0));
    EXPECT_LT((gimbal_angles<double>(gimbal_chain(angles)) - angles).norm(), 1e-12);
  }
}

TEST(CaseHeading, KeepsTheMiddleGimbalBelowSixtyDegrees) {
  for (const auto name : preset_names)
    for (const CommandLaw mode : {CommandLaw::free, CommandLaw::level}) {
      const Timeline timeline = preset_timeline(name, mode);
      for (const Interval& i : timeline.intervals) {
        if (i.heading_rate() != 0.0) continue;  // the case is on its way
        const Mat3 R_cp =
            case_attitude(i.heading1).transpose() * timeline.nodes[i.last_node()].R_lr;
        EXPECT_LE(std::abs(gimbal_angles<double>(R_cp)[1]), middle_gimbal_limit + 1e-9) << name;
      }
    }
}

TEST(CaseHeading, AHeadingThatLocksTheGimbalsIsRefused) {
  TestPlan plan = *preset_plan("six", {});
  plan.positions[2].case_heading = 0.0;  // z north, x of the case north
  try {
    lay_out(plan, harbin);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::config);
    EXPECT_NE(e.messages().front().find("position 3"), std::string::npos) << e.what();
  }
}

TEST(Layout, ASlewEndsAtTheNominalAttitude) {
  for (const CommandLaw mode : {CommandLaw::free, CommandLaw::level}) {
    PlanDefaults defaults;
    defaults.mode = mode;
    const TestPlan plan = *preset_plan("slew12", defaults);
    const Timeline timeline = lay_out(plan, harbin);
    EXPECT_EQ(timeline.chains, 1);
    for (std::size_t k = 1; k < timeline.intervals.size(); ++k) {
      const Interval &before = timeline.intervals[k - 1], &now = timeline.intervals[k];
      EXPECT_DOUBLE_EQ(before.t1, now.t0);
      if (before.slew && !now.slew) {
        EXPECT_LT((timeline.nodes[now.first_node].R_lr - plan.positions[now.position].R_lp).norm(),
                  1e-9);
      }
    }
  }
}

TEST(Layout, ALevelDwellStandsStillAndAFreeOneTurnsWithTheSky) {
  const Timeline level = preset_timeline("six", CommandLaw::level),
                 free = preset_timeline("six", CommandLaw::free);
  const auto turned = [](const Timeline& t) {
    return rotation_vector(t.nodes[0].R_lr.transpose() * t.nodes[t.intervals[59].last_node()].R_lr)
        .norm();
  };
  EXPECT_LT(turned(level), 1e-12);
  EXPECT_NEAR(turned(free), 15.041 * detail::deg, 1e-5);
}

TEST(Layout, WeightsOfTheMeanSumToOneAndIntegrateCubicsAndWhereTheyAreEvenQuintics) {
  for (const int substeps : {1, 2, 5, 6}) {
    double sum = 0.0, cubic = 0.0, quintic = 0.0;
    for (std::size_t k = 0; k <= 2 * static_cast<std::size_t>(substeps); ++k) {
      const double x = static_cast<double>(k) / (2.0 * substeps),
                   w = Timeline::mean_weight(substeps, k);
      sum += w;
      cubic += w * x * x * x;
      quintic += w * x * x * x * x * x;
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_NEAR(cubic, 0.25, 1e-14);
    if (substeps % 2 == 0) {
      EXPECT_NEAR(quintic, 1.0 / 6.0, 1e-14);
    }
  }
}

TEST(Layout, ARecordingIsLaidOutAsItsPlan) {
  for (const auto name : preset_names) {
    const TestPlan plan = *preset_plan(name, {});
    const Timeline planned = lay_out(plan, harbin);
    const auto n = static_cast<Eigen::Index>(planned.intervals.size());
    const Recording recording = make_recording(
        planned, {Mat3X::Constant(3, n, std::nan("")), Mat3X::Constant(3, n, std::nan(""))}, {});
    const Timeline read = lay_out(recording, plan, harbin);
    ASSERT_EQ(read.intervals.size(), planned.intervals.size()) << name;
    ASSERT_EQ(read.nodes.size(), planned.nodes.size()) << name;
    for (std::size_t k = 0; k < read.nodes.size(); ++k) {
      EXPECT_NEAR(read.nodes[k].t, planned.nodes[k].t, 1e-6);
      EXPECT_LT((read.nodes[k].R_lr - planned.nodes[k].R_lr).norm(), 1e-9) << name;
      EXPECT_LT((read.nodes[k].omega_ic_l - planned.nodes[k].omega_ic_l).norm(), 1e-12) << name;
    }
  }
}

}  // namespace
}  // namespace drift::timeline_test
