// A fit that ends in another valley of a period is no sign of another latitude.
#include <gtest/gtest.h>

#include <initializer_list>

#include "analysis/identification/latitude_doubt.hpp"
#include "tests/support/own_terms.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::other_valley_test {
namespace {

using identification::latitude_doubt;

/// Twelve free positions of half an hour with a drift that swings by 0.3 deg/h, and a study that
/// has its term and waits for a period of 37 min.
struct Scene {
  test::OwnTermsHeld held{
      "[[term]]\nkey = \"mine\"\nacts_on = \"drift.y\"\n"
      "equation = \"A*sin(2*pi*t/P)*step(abs(f_z) - 0.5)\"\n"
      "parameters = { A = { unit = \"deg/h\", prior = 0.5 }, "
      "P = { unit = \"min\", value = 37, prior = 4 } }\n"};
  mc::Study study = test::six_study();
  Recording recording;

  explicit Scene(double period_min) {
    PlanDefaults defaults;
    defaults.dwell = 1800.0;
    defaults.sample = 120.0;
    defaults.mode = CommandLaw::free;
    study.plan = preset_plan("twelve", defaults).value();
    study.truth = test::base_truth(Coupling::eq6);
    study.filters = {test::base_filter(Coupling::eq6)};
    study.truth.active = study.filters.front().active =
        params_named("fixed_drift") | params_named("g_drift") | params_named("accelerometer") |
        params_named("mine");
    const Timeline timeline = lay_out(study.plan, study.site);
    TruthDraw draw = draw_truth(study.truth, timeline.chains, 1, 0);
    draw.theta[test::param("mine_A")] = 0.3 * test::deg_per_h;
    draw.theta[test::param("mine_P")] = period_min * 60.0;
    recording = make_recording(
        timeline, Simulator(study.truth, study.readout).run(timeline, draw, 1, 0).measured,
        study.readout);
  }
  auto doubt() const { return latitude_doubt(study, {recording}, study.filters.front()); }
};

TEST(OtherValley, OfAPeriodIsNoOtherLatitude) {
  for (const double period : {31.0, 35.0, 39.0}) EXPECT_FALSE(Scene(period).doubt()) << period;
}

TEST(OtherValley, DoesNotHideTheOtherHemisphere) {
  Scene s(37.0);
  const double truth = s.study.site.latitude;
  s.study.site.latitude = -truth;
  const auto doubt = s.doubt();
  ASSERT_TRUE(doubt);
  EXPECT_TRUE(doubt->is_on_other_hemisphere());
  EXPECT_NEAR(doubt->latitude, truth, 5.0 * doubt->sigma);
}

}  // namespace
}  // namespace drift::other_valley_test
