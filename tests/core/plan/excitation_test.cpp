#include "core/plan/excitation.hpp"

#include <gtest/gtest.h>

#include "tests/support/model_builders.hpp"

namespace drift::excitation_test {
namespace {

using namespace drift::test;

Position position(std::string_view axes, CommandLaw mode) {
  Position p;
  std::string why;
  p.R_lp = parse_axes(axes, why).value();
  p.mode = mode;
  p.dwell = 600.0;
  return p;
}

Excitation of(std::vector<Position> positions) {
  TestPlan plan;
  plan.positions = std::move(positions);
  return excitation_of(lay_out(plan, harbin));
}

using Axes = std::array<bool, 3>;

TEST(Excitation, AGyroAcrossTheEarthRateIsNotTorquedHeldLevel) {
  // Earth's rate is along north and up: y, which points west, is never told anything.
  const Excitation level = of({position("x=N y=W z=U", CommandLaw::level)});
  EXPECT_EQ(level.commanded, (Axes{true, false, true}));
  EXPECT_EQ(of({position("x=N y=W z=U", CommandLaw::free)}).commanded, Axes{});
  EXPECT_EQ(
      of({position("x=N y=W z=U", CommandLaw::free), position("x=W y=S z=U", CommandLaw::level)})
          .commanded,
      (Axes{false, true, true}));
}

TEST(Excitation, ASlewTorques) {
  Position turned = position("x=U y=W z=S", CommandLaw::free);  // about y
  turned.entry = Entry::torqued;
  EXPECT_TRUE(of({position("x=N y=W z=U", CommandLaw::free), turned}).commanded[1]);
}

TEST(Excitation, ProductsOfTwoAxesNeedBothOffTheHorizontal) {
  const Excitation upright =
      of({position("x=N y=W z=U", CommandLaw::level), position("x=U y=N z=W", CommandLaw::level)});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_EQ(upright.along_both[i][j], i == j && i != 1) << i << j;
  const Excitation tilted = of({position("x=UN y=US z=E", CommandLaw::level)});
  EXPECT_TRUE(tilted.along_both[0][1] && tilted.along_both[1][0]);
  EXPECT_FALSE(tilted.along_both[0][2] || tilted.along_both[1][2]);
  // Left to itself the platform is turned by the Earth: z tilts about north.
  EXPECT_TRUE(of({position("x=N y=W z=U", CommandLaw::free)}).along_both[1][2]);
}

}  // namespace
}  // namespace drift::excitation_test
