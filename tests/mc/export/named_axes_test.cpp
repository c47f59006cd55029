#include "mc/export/named_axes.hpp"

#include <gtest/gtest.h>

#include "tests/mc/small_study.hpp"

namespace drift::named_axes_test {
namespace {

using namespace drift::test;

mc::NamedAxes axes_of(const std::string& sweep) {
  return mc::NamedAxes(mc::study_points(read_text(small_study + sweep)));
}

TEST(NamedAxes, NameWhatThePointsHave) {
  const mc::NamedAxes axes = axes_of("");
  EXPECT_EQ(axes.filters, (std::vector<std::string>{"right", "wrong"}));
  EXPECT_EQ(axes.starts, 2u) << "of the filter that has most";
  EXPECT_EQ(axes.params.size(), 15u);
  EXPECT_EQ(axes.parameter(TermLibrary::index("D_F_y")), 1u);
  EXPECT_EQ(axes.with_point({"run"}), (std::vector<std::string>{"run"})) << "one point";
  EXPECT_TRUE(axes.swept.empty());
}

TEST(NamedAxes, SweptQuantitiesAreNumbersInTheUnitOfTheFirst) {
  const mc::NamedAxes axes = axes_of(
      "[sweep]\n\"truth.parameters.eta_x\" = [\"20 arcsec\", \"5 arcmin\"]\n"
      "\"truth.coupling\" = [\"eq5\", \"eq6\"]\n");
  ASSERT_EQ(axes.points.size(), 4u);
  EXPECT_EQ(axes.with_point({"run"}), (std::vector<std::string>{"point", "run"}));
  ASSERT_EQ(axes.swept.size(), 2u);
  EXPECT_EQ(axes.swept[0].unit.symbol.view(), "arcsec");
  ASSERT_EQ(axes.swept[0].numbers.size(), 4u);
  EXPECT_EQ(axes.swept[0].numbers[1], 20.0) << "as written";
  EXPECT_EQ(axes.swept[0].numbers[2], 300.0) << "a decimal stays one";
  EXPECT_TRUE(axes.swept[1].numbers.empty());
  EXPECT_EQ(axes.swept[1].words, (std::vector<std::string>{"eq5", "eq6", "eq5", "eq6"}));
}

TEST(NamedAxes, WhatIsSweptTogetherIsNamedApart) {
  const mc::NamedAxes axes = axes_of(
      "[sweep]\n\"readout\" = [{ accelerometer_noise = \"1 ug\", gimbal_noise = \"2 arcsec\" }, "
      "{ accelerometer_noise = \"20 ug\", gimbal_noise = \"3 arcsec\" }]\n");
  ASSERT_EQ(axes.swept.size(), 2u);
  EXPECT_EQ(axes.swept[0].title(), "readout.accelerometer_noise [ug]");
  EXPECT_EQ(axes.swept[0].numbers, (std::vector<double>{1.0, 20.0}));
  EXPECT_EQ(axes.swept[1].title(), "readout.gimbal_noise [arcsec]");
  EXPECT_EQ(axes.swept[1].numbers, (std::vector<double>{2.0, 3.0}));
}

TEST(NamedAxes, NoCoordinateHasTheNameOfAnythingElse) {
  // Tables of other keys are one coordinate, called as the section is.
  const std::string sweep =
      "[sweep]\ntruth = [{ coupling = \"eq6\" }, { initial_attitude = \"9 arcsec\" }]\n"
      "\"plan.dwell\" = [\"10 min\", \"20 min\"]\n";
  const auto points = mc::study_points(read_text(small_study + sweep));
  const auto named = [&](std::set<std::string> others) {
    return mc::NamedAxes(points, std::move(others)).coordinates;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(named({}), (Names{"truth", "plan_dwell"}));
  EXPECT_EQ(named({"truth", "estimate"}), (Names{"truth_", "plan_dwell"}));
  EXPECT_EQ(named({"truth", "truth_", "plan_dwell"}), (Names{"truth__", "plan_dwell_"}));
}

TEST(NamedAxes, ADistributionIsNoNumber) {
  const mc::NamedAxes axes = axes_of(
      "[sweep]\n\"truth.parameters.eta_x\" = [\"20 arcsec\", { normal = [\"1 arcsec\", \"2 "
      "arcsec\"] "
      "}]\n");
  ASSERT_EQ(axes.swept.size(), 1u);
  EXPECT_TRUE(axes.swept[0].numbers.empty());
  EXPECT_EQ(axes.swept[0].title(), "truth.parameters.eta_x");
}

}  // namespace
}  // namespace drift::named_axes_test
