// Time constants far below and above those that the library looks for: what is stated of them, and
// of all that goes with them, is what the test says.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::settings_beyond_grid_test {
namespace {

using namespace drift::test;

/// The diagnosis of a drift of 0.4 deg/h that dies away with a time constant [min].
Diagnosis of_warm_up(double minutes) {
  const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1800.0, 120.0);
  TruthSpec truth = base_truth(Coupling::eq6);
  truth.active |= params_named("warmup_drift");
  const Readout readout;
  TruthDraw draw = draw_truth(truth, timeline.chains, 3, 0);
  for (const char* other : {"W_y", "W_z"}) draw.theta[param(other)] = 0.0;
  draw.theta[param("W_x")] = 0.4 * TermLibrary::specs[param("W_x")].unit.to_si;
  draw.theta[param("W_tau")] = minutes * 60.0;
  const Measurements measured = Simulator(truth, readout).run(timeline, draw, 3, 0).measured;
  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.whiteness_draws = 0;
  options.profiles = Profiles::of_the_causes;
  return diagnose(base_filter(Coupling::eq6), {timeline, readout, measured}, {}, {}, options);
}

class SettingBeyondTheGrid : public testing::TestWithParam<double> {};

TEST_P(SettingBeyondTheGrid, IsStatedWithinItsIntervalWhichHasItsSign) {
  const Diagnosis d = of_warm_up(GetParam());
  ASSERT_FALSE(d.causes.empty()) << report::sentence(d);
  std::size_t settings = 0;
  for (const search::Cause& cause : d.causes)
    for (const search::CauseParameter& p : cause.parameters) {
      if (std::isfinite(p.low_95)) EXPECT_GE(p.value, p.low_95) << p.key;
      if (std::isfinite(p.high_95)) EXPECT_LE(p.value, p.high_95) << p.key;
      if (!TermLibrary::specs[p.param].continuous()) continue;
      ++settings;
      EXPECT_GT(p.low_95, 0.0) << p.key << ": a time does not end before it begins";
    }
  EXPECT_GE(settings, 1u) << report::sentence(d);
}

INSTANTIATE_TEST_SUITE_P(Minutes, SettingBeyondTheGrid, testing::Values(3.0, 300.0, 600.0));

}  // namespace
}  // namespace drift::diagnosis::settings_beyond_grid_test
