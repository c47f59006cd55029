// Rows of one position that are further apart than those of the others.
#include "core/plan/plan_rows.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "core/base/units.hpp"

namespace drift::plan_rows_test {
namespace {

/// Positions of twelve rows at these distances [s].
Recording dwells(const std::vector<double>& steps) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"position", unit::one, {}}};
  double t = 0.0, number = 0.0;
  for (const double step : steps) {
    number += 1.0;
    for (int k = 0; k < 12; ++k) {
      r.channels[0].values.push_back(t += step);
      r.channels[1].values.push_back(number);
      r.lines.push_back(r.lines.size() + 1);
    }
  }
  return r;
}

/// A plan of positions with these samples [s].
TestPlan planned(const std::vector<double>& samples) {
  TestPlan plan;
  for (const double sample : samples) {
    plan.positions.emplace_back();
    plan.positions.back().sample = sample;
  }
  return plan;
}

const TestPlan minutes = planned({60.0, 60.0, 60.0, 60.0});

TEST(RowsLongerThanOthers, AreNamedWithWhatToDo) {
  const std::string one = rows_longer_than_others(dwells({60.0, 60.0, 60.0, 120.0}), minutes);
  EXPECT_TRUE(one.starts_with("rows of position 4 are 120 s apart where those of others are 60 s"))
      << one;
  EXPECT_NE(one.find("if rows were lost, put each back"), std::string::npos) << one;
  const std::string two = rows_longer_than_others(dwells({180.0, 60.0, 120.0, 60.0}), minutes);
  EXPECT_TRUE(two.starts_with("rows of positions 1, 3 are 120 to 180 s apart")) << two;
}

TEST(RowsLongerThanOthers, AreNoneWhereThePlanHasThemOrNoneIsUsual) {
  const TestPlan own = planned({60.0, 60.0, 60.0, 120.0});
  for (const auto& [steps, plan] :
       {std::pair{std::vector{60.0, 60.0, 60.0, 60.0}, &minutes},
        {{60.0, 60.0, 60.0, 120.0}, &own},      // as planned
        {{1.0, 1.0, 1.0, 2.0}, &own},           // in samples of the plan
        {{60.0, 60.0, 60.0, 100.0}, &minutes},  // no multiple: no row of it is on their grid
        {{1.0, 2.0, 3.0, 4.0}, &minutes}})      // no step is that of more than half
    EXPECT_EQ(rows_longer_than_others(dwells(steps), *plan), "") << steps[3];
}

TEST(RowsLongerThanOthers, AreNamedWhereOneOtherIsAsPlanned) {
  const Recording r = dwells({60.0, 120.0, 120.0});
  EXPECT_NE(rows_longer_than_others(r, minutes), "");
  EXPECT_EQ(rows_longer_than_others(r, planned({1.0, 1.0, 1.0})), "");
}

}  // namespace
}  // namespace drift::plan_rows_test
