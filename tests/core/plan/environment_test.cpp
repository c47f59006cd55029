#include "core/plan/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "core/plan/environment_config.hpp"
#include "core/sim/measurements.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::environment_test {
namespace {

using namespace drift::test;

constexpr const CovariateSpec& temperature = covariate("temperature");

Environment read(const std::string& text, std::vector<std::string>* mistakes = nullptr) {
  const config::Node root = config::parse_document(text, "study.toml");
  config::Report report("study.toml");
  config::Section top(report, &root, {}, "");
  const Environment e = read_environment(top.section("environment"));
  try {
    report.throw_if_wrong();
  } catch (const InputError& error) {
    if (mistakes) *mistakes = error.messages();
  }
  return e;
}

TEST(Environment, IsReadWithItsUnits) {
  const Environment e = read(R"([environment]
temperature = "20 degC"
temperature_ramp = "0.36 degC/h"
temperature_period = "24 h"
field_n = "0.26 gauss"
field_w = "0 gauss"
field_u = "-48 uT"
)");
  EXPECT_EQ(e[temperature].mean[0], 20.0);
  EXPECT_NEAR(e[temperature].ramp, 1e-4, 1e-18);
  EXPECT_EQ(e[temperature].period, 86400.0);
  EXPECT_NEAR(*e[covariate("field")].mean[2], -0.48e-4, 1e-18);
  EXPECT_EQ(e.declared(), temperature.set() | covariate("field").set());
  EXPECT_EQ(read("schema = 1\n").declared(), 0u);
}

TEST(Environment, EveryCovariateMayBeDeclared) {
  const Environment e = read(harbin_day_text()), day = harbin_day();
  for (const CovariateSpec& c : known_covariates) {
    for (std::size_t k = 0; k < c.components(); ++k) {
      ASSERT_TRUE(e[c].mean[k]) << c.name;
      EXPECT_NEAR(*e[c].mean[k], *day[c].mean[k], 1e-8 * c.usual * c.unit.to_si) << c.name;
    }
    EXPECT_NEAR(e[c].amplitude, day[c].amplitude, 1e-8 * c.usual * c.unit.to_si) << c.name;
    EXPECT_NEAR(e[c].ramp, day[c].ramp, 1e-10 * c.usual * c.unit.to_si) << c.name;
  }
}

TEST(Environment, ItsMistakesAreNamed) {
  for (const auto& [text, expected] :
       {std::pair{"temperature_ramp = \"1 degC/h\"", "temperature = \"20 degC\""},
        {"field_n = \"0.2 gauss\"", "all three"},
        {"temprature = \"20 degC\"", "temperature"},
        {"temperature = \"20 gauss\"", "degC"}}) {
    std::vector<std::string> mistakes;
    read(std::string("[environment]\n") + text + "\n", &mistakes);
    ASSERT_FALSE(mistakes.empty()) << text;
    EXPECT_NE(mistakes.front().find(expected), std::string::npos) << mistakes.front();
  }
}

TEST(Environment, FluctuatesByTheDrawsOfItsSeedForGood) {
  Timeline planned = lay_out(preset_plan("six", PlanDefaults{}).value(), harbin);
  Environment e;
  e[temperature].mean[0] = 20.0;
  e[temperature].fluctuation = 0.01;
  set_environment(planned, e, 3, 1);
  Stream stream(3, 1, Purpose::environment, 0);  // its number, as of the first studies
  stream.normal();                               // of the begin
  const double first = stream.normal(), second = stream.normal();
  // Less the mean of all: rounding of 0.01.
  EXPECT_NEAR(planned.intervals[1].around1[temperature] - planned.intervals[0].around1[temperature],
              0.01 * (second - first), 1e-15);
}

TEST(Environment, IsTheSameInTheTestAndInItsRecording) {
  PlanDefaults defaults;
  defaults.dwell = 600.0;
  const TestPlan plan = preset_plan("slew12", defaults).value();
  Timeline planned = lay_out(plan, harbin);
  Environment e = harbin_day();
  for (const CovariateSpec& c : known_covariates)
    if (!c.is_vector()) e[c].fluctuation = 0.005 * c.usual * c.unit.to_si;
  set_environment(planned, e, 3, 1);
  const auto n = static_cast<Eigen::Index>(planned.intervals.size());
  Recording recording = make_recording(
      planned, {Mat3X::Constant(3, n, std::nan("")), Mat3X::Constant(3, n, std::nan(""))}, {});
  const Timeline laid_out = lay_out(recording, plan, harbin);
  EXPECT_EQ(laid_out.carried, every_known_covariate);
  for (const CovariateSpec& c : known_covariates)
    for (std::size_t place = c.first; place < c.first + c.components(); ++place) {
      const double rounding = 1e-13 * c.usual * c.unit.to_si;
      EXPECT_NEAR(laid_out.mean.value[place], planned.mean.value[place], 10.0 * rounding);
      double sum = 0.0, largest = 0.0;
      for (std::size_t k = 0; k < laid_out.intervals.size(); ++k) {
        const Interval &a = laid_out.intervals[k], &b = planned.intervals[k];
        EXPECT_NEAR(a.around0.value[place], b.around0.value[place], 10.0 * rounding) << c.name;
        EXPECT_NEAR(a.around1.value[place], b.around1.value[place], 10.0 * rounding) << c.name;
        EXPECT_EQ(a.t_dwell, b.t_dwell);
        sum += a.around1.value[place];
        largest = std::max(largest, std::abs(a.around1.value[place]));
      }
      EXPECT_GT(largest, 0.0) << c.name;
      if (!c.is_vector()) {
        EXPECT_NEAR(sum, 0.0, 1e4 * rounding) << c.name;
      }
    }
}

TEST(Environment, IsAPureFunctionOfSeedAndRun) {
  Environment e = harbin_day();
  e[temperature].fluctuation = 0.05;
  const auto last = [&](std::uint64_t run) {
    Timeline t = preset_timeline("six", CommandLaw::free, 600.0);
    set_environment(t, e, 3, run);
    return t.intervals.back().around1[temperature];
  };
  EXPECT_EQ(last(1), last(1));
  EXPECT_NE(last(1), last(2));
}

TEST(Environment, GapsInACovariateAreClosedByStraightLines) {
  const TestPlan plan = preset_plan("six", PlanDefaults{600.0, 60.0, {}, {}}).value();
  const Timeline planned = lay_out(plan, harbin);
  const auto n = static_cast<Eigen::Index>(planned.intervals.size());
  Recording recording = make_recording(
      planned, {Mat3X::Constant(3, n, std::nan("")), Mat3X::Constant(3, n, std::nan(""))}, {});
  Channel column{"temperature", "degC"_unit,
                 std::vector<double>(static_cast<std::size_t>(n), std::nan(""))};
  column.values[10] = 20.0;
  column.values[20] = 21.0;
  recording.channels.push_back(column);
  const Timeline t = lay_out(recording, plan, harbin);
  ASSERT_TRUE(t.carries(temperature));
  const auto at = [&](std::size_t k) {
    return t.mean[temperature] + t.intervals[k].around1[temperature];
  };
  EXPECT_NEAR(at(0), 20.0, 1e-12);
  EXPECT_NEAR(at(15), 20.5, 1e-12);
  EXPECT_NEAR(at(50), 21.0, 1e-12);
  // A channel without a number is no covariate.
  recording.channels.back().values.assign(static_cast<std::size_t>(n), std::nan(""));
  EXPECT_FALSE(lay_out(recording, plan, harbin).carries(temperature));
}

}  // namespace
}  // namespace drift::environment_test
