#include "core/plan/environment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "core/plan/environment_config.hpp"
#include "core/sim/measurements.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::environment_test {
namespace {

using namespace drift::test;

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
  EXPECT_EQ(e.temperature, 20.0);
  EXPECT_NEAR(e.temperature_ramp, 1e-4, 1e-18);
  EXPECT_EQ(e.temperature_period, 86400.0);
  EXPECT_NEAR(*e.field_u, -0.48e-4, 1e-18);
  EXPECT_FALSE(read("schema = 1\n").temperature);
  EXPECT_FALSE(read("schema = 1\n").has_field());
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

TEST(Environment, IsTheSameInTheTestAndInItsRecording) {
  PlanDefaults defaults;
  defaults.dwell = 600.0;
  const TestPlan plan = preset_plan("slew12", defaults).value();
  Timeline planned = lay_out(plan, harbin);
  Environment e = harbin_day();
  e.temperature_fluctuation = 0.05;
  set_environment(planned, e, 3, 1);
  const auto n = static_cast<Eigen::Index>(planned.intervals.size());
  Recording recording = make_recording(
      planned, {Mat3X::Constant(3, n, std::nan("")), Mat3X::Constant(3, n, std::nan(""))}, {});
  const Timeline laid_out = lay_out(recording, plan, harbin);
  ASSERT_TRUE(laid_out.has_temperature && laid_out.has_field);
  EXPECT_NEAR(laid_out.mean_temperature, planned.mean_temperature, 1e-12);
  double mean = 0.0;
  for (std::size_t k = 0; k < laid_out.intervals.size(); ++k) {
    const Interval &a = laid_out.intervals[k], &b = planned.intervals[k];
    EXPECT_NEAR(a.around0.temperature, b.around0.temperature, 1e-12);
    EXPECT_NEAR(a.around1.temperature, b.around1.temperature, 1e-12);
    EXPECT_LT((a.around1.field_l - b.around1.field_l).norm(), 1e-18);
    EXPECT_EQ(a.t_dwell, b.t_dwell);
    mean += a.around1.temperature;
  }
  EXPECT_NEAR(mean, 0.0, 1e-9);
}

TEST(Environment, IsAPureFunctionOfSeedAndRun) {
  Environment e = harbin_day();
  e.temperature_fluctuation = 0.05;
  const auto last = [&](std::uint64_t run) {
    Timeline t = preset_timeline("six", CommandLaw::free, 600.0);
    set_environment(t, e, 3, run);
    return t.intervals.back().around1.temperature;
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
  Channel temperature{"temperature", "degC"_unit,
                      std::vector<double>(static_cast<std::size_t>(n), std::nan(""))};
  temperature.values[10] = 20.0;
  temperature.values[20] = 21.0;
  recording.channels.push_back(temperature);
  const Timeline t = lay_out(recording, plan, harbin);
  ASSERT_TRUE(t.has_temperature);
  const auto at = [&](std::size_t k) {
    return t.mean_temperature + t.intervals[k].around1.temperature;
  };
  EXPECT_NEAR(at(0), 20.0, 1e-12);
  EXPECT_NEAR(at(15), 20.5, 1e-12);
  EXPECT_NEAR(at(50), 21.0, 1e-12);
  // A channel without a number is no covariate.
  recording.channels.back().values.assign(static_cast<std::size_t>(n), std::nan(""));
  EXPECT_FALSE(lay_out(recording, plan, harbin).has_temperature);
}

}  // namespace
}  // namespace drift::environment_test
