#include "analysis/planning/candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/support/model_builders.hpp"

namespace drift::planning::candidates_test {
namespace {

using detail::deg;

TEST(Candidates, TheCaseIsTurnedHalfAndOnceRoundForwardAndBack) {
  const auto degrees = [](double left) {
    std::vector<double> all;
    const auto headings = headings_after(left * deg);
    EXPECT_FALSE(headings.front()) << "first as the gimbals need";
    for (std::size_t k = 1; k < headings.size(); ++k) all.push_back(*headings[k] / deg);
    return all;
  };
  const auto expect_near = [](const std::vector<double>& is, const std::vector<double>& wanted) {
    ASSERT_EQ(is.size(), wanted.size());
    for (std::size_t k = 0; k < is.size(); ++k) EXPECT_NEAR(is[k], wanted[k], 1e-9);
  };
  expect_near(degrees(360.0), {540.0, 180.0, 720.0, 0.0});
  expect_near(degrees(44.7), {225.0, -135.0, 405.0, -315.0});  // whole degrees
  expect_near(degrees(36000.0), {35820.0, 35640.0});           // no study file has more
}

TEST(Candidates, FollowTheHeadingThatAPlanLeftTheCaseAt) {
  PlanDefaults defaults;
  defaults.dwell = 600.0;
  defaults.sample = 120.0;
  TestPlan plan = preset_plan("slew12", defaults).value();
  plan.positions.resize(1);
  const observability::RankedModel model =
      observability::ranked_model(test::base_spec(Coupling::eq5), nullptr, test::harbin, Readout{});
  Candidates candidates(plan, model);
  EXPECT_TRUE(candidates.is_caged(candidates.size() - 1)) << "a plan that never slews";
  plan.positions.push_back(plan.positions.front());
  plan.positions.back().entry = Entry::torqued;
  plan.positions.back().case_heading = 180.0 * deg;
  Candidates slewed(plan, model);
  const auto headings_of = [](const Candidates& c) {
    std::set<int> all;
    for (std::size_t k = 0; k < c.size(); ++k)
      if (c.position(k).case_heading)
        all.insert(static_cast<int>(std::lround(*c.position(k).case_heading / deg)));
    return all;
  };
  EXPECT_EQ(headings_of(slewed), (std::set<int>{-180, 0, 360, 540}));
  plan.positions.back().case_heading = 0.0;
  slewed.renew(plan);
  EXPECT_EQ(headings_of(slewed), (std::set<int>{-360, -180, 180, 360}));
}

}  // namespace
}  // namespace drift::planning::candidates_test
