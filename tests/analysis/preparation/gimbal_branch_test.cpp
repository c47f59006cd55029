// A chain of three gimbals has two sets of angles for every attitude.
#include "analysis/preparation/gimbal_branch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/check.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::gimbal_branch_test {
namespace {

/// What is said of it; empty if nothing is.
std::string usual_branch(Recording& r) {
  std::string said = preparation::other_branch(r);
  preparation::take_usual_branch(r);
  return said;
}

constexpr double pi = std::numbers::pi;

/// The same attitude by the other angles.
void turn_over(Recording& r, std::size_t row) {
  double& middle = test::channel(r, "gimbal_middle")[row];
  for (const char* name : {"gimbal_outer", "gimbal_inner"}) {
    double& angle = test::channel(r, name)[row];
    angle = std::remainder(angle + pi, 2.0 * pi);
  }
  middle = std::remainder(pi - middle, 2.0 * pi);
}

TEST(GimbalBranch, TheOtherAnglesOfAnAttitudeAreTakenAsTheUsualOnes) {
  const Recording usual = test::simulated(test::six_study());
  Recording r = usual;
  for (std::size_t k = 20; k < r.rows(); ++k) turn_over(r, k);
  const std::string said = usual_branch(r);
  EXPECT_NE(
      said.find("more than 90 deg from its zero in " + std::to_string(r.rows() - 20) + " rows"),
      std::string::npos)
      << said;
  for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
    for (std::size_t k = 0; k < r.rows(); ++k) {
      const double is = r.find(name)->values[k], was = usual.find(name)->values[k];
      EXPECT_NEAR(std::remainder(is - was, 2.0 * pi), 0.0, 1e-14) << name << " " << k;
    }
}

TEST(GimbalBranch, NothingIsTurnedThatIsUsualMissingOrInAnotherUnit) {
  const Recording usual = test::simulated(test::six_study());
  Recording r = usual;
  EXPECT_EQ(usual_branch(r), "");
  turn_over(r, 5);
  test::channel(r, "gimbal_inner")[5] = std::nan("");
  EXPECT_EQ(usual_branch(r), "");
  Recording other_unit = usual;
  turn_over(other_unit, 5);
  test::channel(other_unit, "gimbal_middle")[9] = 57.3;
  EXPECT_EQ(usual_branch(other_unit), "");
}

TEST(GimbalBranch, ARecordingByEitherIsPreparedAlike) {
  const mc::Study study = test::six_study();
  Recording r = test::simulated(study);
  const auto before = preparation::prepare(study, {r}).recordings.front();
  for (std::size_t k = 0; k < r.rows(); ++k) turn_over(r, k);
  const auto prepared = preparation::prepare(study, {r});
  EXPECT_TRUE(test::says(prepared, "outer + 180 deg"));
  for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
    for (std::size_t k = 0; k < r.rows(); ++k)
      EXPECT_NEAR(std::remainder(prepared.recordings.front().find(name)->values[k] -
                                     before.find(name)->values[k],
                                 2.0 * pi),
                  0.0, 1e-14);
}

TEST(GimbalBranch, AColumnInThePlaceOfTheMiddleGimbalIsNoOtherBranch) {
  using Names = std::pair<const char*, const char*>;
  for (const char* preset : {"six", "twelve"}) {
    mc::Study study = test::six_study();
    study.plan = preset_plan(preset, PlanDefaults{1200.0, 60.0, {}, {}}).value();
    for (const auto& [a, b] :
         {Names{"gimbal_outer", "gimbal_middle"}, Names{"gimbal_middle", "gimbal_inner"},
          Names{"gimbal_outer", "gimbal_inner"}}) {
      Recording r = test::simulated(study);
      std::swap(test::channel(r, a), test::channel(r, b));
      const std::string line = fmt::format("columns = {{ {0} = \"{1}\", {1} = \"{0}\" }}", a, b);
      try {
        preparation::prepare(study, {r});
        ADD_FAILURE() << preset << ": " << line;
      } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find(line), std::string::npos) << preset << e.what();
      }
    }
  }
}

}  // namespace
}  // namespace drift::gimbal_branch_test
