// Columns that own terms follow are looked at like the temperature.
#include "analysis/preparation/covariates/own_columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/preparation/covariates.hpp"
#include "analysis/preparation/prepare.hpp"
#include "core/base/check.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "tests/support/own_terms.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::own_columns_test {
namespace {

struct OwnColumns : testing::Test {
  test::OwnTermsHeld held{test::own_term("mine", "drift.y", "B*oil", "B = { prior = 1e-9 }")};
  mc::Study study = test::six_study();

  /// A recording of some name whose oil reads so much in every row [unit of the file].
  Recording with_oil(const char* source, const Unit& unit, double value) const {
    Recording r = test::simulated(study);
    r.source = source;
    r.channels.push_back({"oil", unit, std::vector<double>(r.rows(), value * unit.to_si)});
    return r;
  }
  /// The refusal; empty if there is none.
  static std::string refusal(const std::vector<Recording>& recordings,
                             std::vector<std::string> remarks = {}) {
    const auto wrong = mistakes_of_own_columns(recordings, remarks);
    EXPECT_LE(wrong.size(), 1u);
    return wrong.empty() ? "" : wrong.front();
  }
};

TEST_F(OwnColumns, HaveTemperaturesOfATest) {
  struct Case {
    Unit unit;
    double value;
    bool good;
  };
  const Unit fahrenheit = parse_recording_unit("degF").value();
  // 250 degC are 523.15 K and 482 degF; a difference in K may be small.
  for (const Case& c :
       {Case{"degC"_unit, 20.0, true}, Case{"degC"_unit, 249.0, true},
        Case{"degC"_unit, 293.4, false}, Case{"degC"_unit, -9999.0, false},
        Case{"K"_unit, 293.4, true}, Case{"K"_unit, 0.5, true}, Case{"K"_unit, 523.0, true},
        Case{"K"_unit, 524.0, false}, Case{fahrenheit, 481.0, true}, Case{fahrenheit, 483.0, false},
        Case{"V"_unit, 9999.0, true}, Case{unit::one, 9999.0, true}})
    EXPECT_EQ(refusal({with_oil("a.csv", c.unit, c.value)}).empty(), c.good)
        << c.value << c.unit.symbol.view();
  const Recording r = with_oil("a.csv", "degC"_unit, 293.4);
  const std::string said = refusal({r});
  EXPECT_NE(said.find("oil: the value 293.4 is beyond reason (expected at most 250 degC"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find(fmt::format("({} more of the kind", r.rows() - 1)), std::string::npos)
      << said;
  EXPECT_THROW(prepare(study, {r}), InputError);
}

TEST_F(OwnColumns, AreOneQuantityInAllRecordings) {
  const Recording warm = with_oil("a.csv", "degC"_unit, 20.0);
  std::vector<std::string> remarks;
  const std::string said = refusal({warm, with_oil("b.csv", "V"_unit, 0.7)});
  EXPECT_EQ(said.find("b.csv:oil: is in [V], in a.csv it is in [degC]"), 0u) << said;
  EXPECT_EQ(refusal({warm, with_oil("b.csv", "K"_unit, 293.15)}), "");
  EXPECT_TRUE(mistakes_of_own_columns({warm, warm}, remarks).empty());
  EXPECT_TRUE(remarks.empty());
  const Recording plain = with_oil("b.csv", unit::one, 20.0);
  EXPECT_TRUE(mistakes_of_own_columns({plain, warm}, remarks).empty());
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks.front().find("b.csv: oil has no unit, in a.csv it is in [degC]"), 0u)
      << remarks.front();
}

TEST_F(OwnColumns, WhatNoTermFollowsIsNotJoinedWithAnotherQuantity) {
  Recording a = with_oil("a.csv", "degC"_unit, 20.0), b = with_oil("b.csv", "V"_unit, 0.7);
  for (Recording* r : {&a, &b}) r->channels.back().name = "case_sensor";
  EXPECT_EQ(refusal({a, b}), "");
  const auto all = covariates_of({a, b});
  const auto joined = std::ranges::find(all, "case_sensor", &Covariate::name);
  ASSERT_NE(joined, all.end());
  ASSERT_EQ(joined->value.size(), a.rows() + b.rows());
  EXPECT_EQ(joined->value.front(), 20.0);
  EXPECT_TRUE(std::isnan(joined->value.back()));
  b = with_oil("b.csv", "K"_unit, 293.15);
  b.channels.back().name = "case_sensor";
  const auto both = covariates_of({a, b});
  EXPECT_NEAR(std::ranges::find(both, "case_sensor", &Covariate::name)->value.back(), 20.0, 1e-10);
}

}  // namespace
}  // namespace drift::preparation::own_columns_test
