// Advice on request, followed: what a plan conceals is named once the advised positions are added.
#include <gtest/gtest.h>

#include "analysis/diagnosis/advice/advise.hpp"
#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "core/sim/measurements.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::advice_followed_test {
namespace {

using test::param;

constexpr double heat = 0.05;  // deg/h: one prior sigma

/// Six level positions; gyro y drifts after a slew, and the nominal model does not know.
mc::Study heated_study() {
  mc::Study s;
  s.path = "study.toml";
  s.site = test::harbin;
  PlanDefaults defaults;
  defaults.mode = CommandLaw::level;
  defaults.dwell = 1200.0;
  s.plan = preset_plan("six", defaults).value();
  s.truth = test::base_truth(Coupling::eq5);
  s.truth.active &= ~test::only({"D_II", "D_OO", "D_SS", "D_IO", "D_IS", "D_OS"});
  s.filters = {test::base_filter(Coupling::eq5)};
  s.filters.front().active = s.truth.active;
  s.truth.active |= test::only({"heat_x", "heat_y", "heat_z", "heat_tau"});
  for (const char* key : {"heat_x", "heat_z"}) s.truth.priors[param(key)] = fixed(0.0);
  s.truth.priors[param("heat_y")] = fixed(heat * unit::deg_per_h.to_si);
  s.truth.priors[param("heat_tau")] = TermLibrary::specs[param("heat_tau")].prior_si();
  return s;
}

Diagnosis diagnosed(const mc::Study& s, Recording* recording = nullptr) {
  const Timeline timeline = lay_out(s.plan, s.site);
  const TruthDraw draw = draw_truth(s.truth, timeline.chains, 1, 0);
  const Recording r = make_recording(
      timeline, Simulator(s.truth, s.readout).run(timeline, draw, 1, 0).measured, s.readout);
  if (recording) *recording = r;
  DiagnoseOptions options;
  options.starts = 1;
  options.whiteness_draws = 0;
  return diagnose(s, {r}, options);
}

TEST(AdviceFollowed, AnEffectThatThePlanConcealsIsNamedWithTheAdvisedPositions) {
  mc::Study s = heated_study();
  Recording recording;
  const Diagnosis concealed = diagnosed(s, &recording);
  ASSERT_EQ(concealed.verdict, Verdict::consistent) << report::sentence(concealed);
  const auto advice =
      advise(s, {recording}, concealed, {.asked = std::vector<std::string>{"torquer_heating"}});
  ASSERT_FALSE(advice.empty());
  ASSERT_FALSE(advice.front().plan.empty());
  EXPECT_LT(advice.front().now_sigma, 1.0);
  EXPECT_GT(advice.front().expected_sigma, 8.0);

  s.plan.preset.clear();
  s.plan.positions.insert(s.plan.positions.end(), advice.front().plan.begin(),
                          advice.front().plan.end());
  const Diagnosis seen = diagnosed(s);
  ASSERT_EQ(seen.verdict, Verdict::named) << report::sentence(seen);
  ASSERT_EQ(seen.causes.size(), 1u) << report::sentence(seen);
  EXPECT_EQ(seen.causes[0].term, "torquer_heating");
  EXPECT_EQ(seen.causes[0].axis, "y");
  const search::CauseParameter& found = seen.causes[0].parameters.front();
  EXPECT_NEAR(found.value, heat, 4.0 * found.sigma);
}

}  // namespace
}  // namespace drift::diagnosis::advice_followed_test
