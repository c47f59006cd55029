// Columns of temperatures that own terms name: in degC, whatever the file has them in.
#include "core/plan/celsius_column.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/sim/measurements.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::celsius_column_test {
namespace {

using test::harbin;

/// Six positions with nothing measured but the column `oil`, a number for every row.
class CelsiusColumn : public testing::Test {
 protected:
  Timeline laid_out(const char* unit, const std::function<double(std::size_t)>& number) const {
    const Timeline planned = lay_out(plan_, harbin);
    const auto n = static_cast<Eigen::Index>(planned.intervals.size());
    Recording r = make_recording(
        planned, {Mat3X::Constant(3, n, std::nan("")), Mat3X::Constant(3, n, std::nan(""))}, {});
    Channel oil{"oil", parse_recording_unit(unit).value(), {}};
    for (std::size_t k = 0; k < planned.intervals.size(); ++k)
      oil.values.push_back(number(k) * oil.unit.to_si);
    r.channels.push_back(oil);
    return lay_out(r, plan_, harbin);
  }
  static double seen(const Timeline& t, std::size_t k) { return t.intervals[k].around1.further(0); }

 private:
  TestPlan plan_ = preset_plan("six", PlanDefaults{600.0, 60.0, {}, {}}).value();
  test::OwnTermsHeld held_{
      test::own_term("twin", "drift.y", "A*oil", "A = { unit = 'deg/h/K', prior = 0.03 }")};
};

double celsius(std::size_t row) {
  return 20.0 + 0.01 * static_cast<double>(row);
}

TEST_F(CelsiusColumn, KelvinsAndFahrenheitsAreReadAsDegreesCelsius) {
  const Timeline degC = laid_out("degC", celsius);
  const Timeline K = laid_out("K", [](std::size_t k) { return celsius(k) + 273.15; });
  const Timeline degF = laid_out("degF", [](std::size_t k) { return 1.8 * celsius(k) + 32.0; });
  ASSERT_NE(degC.carried & further_column(0), 0u);
  for (std::size_t k = 0; k < degC.intervals.size(); ++k) {
    EXPECT_NEAR(seen(K, k), seen(degC, k), 1e-12);  // rounding of 300 K
    EXPECT_NEAR(seen(degF, k), seen(degC, k), 1e-12);
  }
}

TEST_F(CelsiusColumn, WhatIsInNeitherKeepsItsZero) {
  EXPECT_DOUBLE_EQ(seen(laid_out("degC", [](std::size_t) { return 20.0; }), 3), 20.0);
  EXPECT_DOUBLE_EQ(seen(laid_out("hPa", [](std::size_t) { return 1000.0; }), 3), 1e5);
  EXPECT_DOUBLE_EQ(seen(laid_out("1", [](std::size_t) { return 294.0; }), 3), 294.0);
}

TEST_F(CelsiusColumn, ADifferenceInKelvinsIsAskedAbout) {
  const auto difference = [](std::size_t k) { return k < 4 ? 290.0 : 0.3; };
  EXPECT_DOUBLE_EQ(seen(laid_out("degC", [](std::size_t) { return 0.3; }), 3), 0.3);
  try {
    laid_out("K", difference);
    ADD_FAILURE() << "0.3 K was taken for a temperature";
  } catch (const InputError& e) {
    ASSERT_EQ(e.messages().size(), 1u);
    for (const char* part : {":5: oil reads 0.3 K", "oil = \"its header as it stands, then [degC]"})
      EXPECT_NE(e.messages()[0].find(part), std::string::npos) << e.messages()[0];
  }
}

}  // namespace
}  // namespace drift::celsius_column_test
