#include "analysis/planning/position_pool.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/plan/timeline.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::planning::position_pool_test {
namespace {

TEST(Attitudes, Are96FramesAsTheirTextSays) {
  const std::vector<Attitude> all = all_attitudes();
  EXPECT_EQ(cardinal_attitudes().size(), 24u);
  EXPECT_EQ(all.size(), 96u);
  std::vector<Mat3> frames;
  for (const Attitude& a : all) {
    std::string why;
    const auto R_lp = parse_axes(a.axes, why);
    ASSERT_TRUE(R_lp) << a.axes << ": " << why;
    EXPECT_EQ(*R_lp, a.R_lp);
    for (const Mat3& other : frames) EXPECT_GT((*R_lp - other).norm(), 0.1) << a.axes;
    frames.push_back(*R_lp);
  }
}

TEST(Attitudes, AreTheCubeAndTheCubeTurnedByHalfARightAngle) {
  const std::vector<Attitude> all = all_attitudes(), cube = cardinal_attitudes();
  const auto nearest = [&](const Mat3& R) {
    double least = 9.0;
    for (const Attitude& a : all) least = std::min(least, (a.R_lp - R).norm());
    return least;
  };
  for (const Attitude& a : cube)
    for (int axis = 0; axis < 3; ++axis)
      for (const double angle : {45.0, -45.0, 90.0})
        EXPECT_LT(nearest(a.R_lp * rotation<double>(angle * detail::deg * Vec3::Unit(axis))), 1e-12)
            << a.axes;
}

TEST(PositionPool, HoldsPositionsOfEveryKindEachOnce) {
  constexpr double usual = 600.0;
  std::set<std::string> names;
  std::size_t slews = 0, level = 0, longer = 0;
  const std::vector<Addition> pool = position_pool(usual, 60.0);
  for (const Addition& a : pool) {
    const std::string name = description(a.back(), usual);
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(a.front().entry, Entry::caged);
    EXPECT_EQ(a.back().sample, 60.0);
    slews += a.size() == 2 ? 1 : 0;
    level += a.back().mode == CommandLaw::level ? 1 : 0;
    longer += a.back().dwell > usual ? 1 : 0;
  }
  // Under two laws: 96 at two headings, 24 for longer, and slews from one of the cube to the 23
  // others.
  EXPECT_EQ(slews, 2u * 23u);
  EXPECT_EQ(longer, 2u * 24u);
  EXPECT_EQ(level, pool.size() / 2);
  EXPECT_EQ(pool.size(), 2u * (2u * 96u + 24u + 23u));
}

TEST(PositionPool, WhatTheGimbalsForbidIsLeftOutAndTheRestKeepsItsOrder) {
  const auto laid_out = [](const Addition& a) {
    TestPlan plan;
    plan.positions = a;
    return lay_out(plan, test::harbin).intervals.size();
  };
  const std::vector<Addition> pool = position_pool(600.0, 60.0);
  std::size_t at = 0;
  const auto possible = integrated(pool, laid_out);
  EXPECT_LT(possible.size(), pool.size());
  EXPECT_GT(possible.size(), pool.size() / 2);
  for (const Addition& a : pool) {
    const bool next = at < possible.size() &&
                      description(possible[at].positions.back(), 0.0) == description(a.back(), 0.0);
    if (next) {
      EXPECT_GE(possible[at++].gain, 10u);  // samples of a dwell
    } else {
      EXPECT_THROW(laid_out(a), InputError) << a.back().axes;
    }
  }
  EXPECT_EQ(at, possible.size());
}

}  // namespace
}  // namespace drift::planning::position_pool_test
