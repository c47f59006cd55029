// A user's own term hidden in a test of a platform: found, named and sized like any other.
#include <gtest/gtest.h>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "core/physics/own/own_scenes.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::own_term_diagnosed_test {
namespace {

using namespace drift::test;

const std::string rumble =
    "[[term]]\nkey = \"bearing_rumble\"\ntitle = \"bearing rumble of the inner gimbal\"\n"
    "acts_on = \"rate.y\"\nequation = \"A * sin(2*pi*t/P) * step(abs(f_z) - 0.8)\"\n"
    "parameters = { A = { unit = \"deg/h\", prior = 0.01 }, P = { unit = \"min\", value = 37, grid "
    "= [33, 35, 37, 39] } }\n";

TEST(Diagnose, ATermThatTheStudyBringsIsNamedWithItsSizeAndPeriod) {
  const OwnTermsHeld held(rumble);
  const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1800.0, 90.0);
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active |= params_named("bearing_rumble");
  TruthDraw draw = draw_truth(truth, timeline.chains, 3, 1);
  draw.theta[param("bearing_rumble_A")] = 0.05 * deg_per_h;
  draw.theta[param("bearing_rumble_P")] = 36.0 * 60.0;  // between the values of the grid
  const Readout readout;
  const Measurements measured = Simulator(truth, readout).run(timeline, draw, 3, 1).measured;
  const diagnosis::Diagnosis d =
      diagnosis::diagnose(base_filter(Coupling::eq5), {timeline, readout, measured}, {}, {}, {});
  ASSERT_EQ(d.verdict, diagnosis::Verdict::named) << report::sentence(d);
  ASSERT_EQ(d.causes.size(), 1u);
  EXPECT_EQ(d.causes[0].term, "bearing_rumble");
  EXPECT_NE(report::sentence(d).find("bearing rumble of the inner gimbal"), std::string::npos);
  for (const search::CauseParameter& p : d.causes[0].parameters) {
    const bool size = p.key == "bearing_rumble_A";
    EXPECT_NEAR(p.value, size ? 0.05 : 36.0, 4.0 * p.sigma) << p.key;
    EXPECT_EQ(p.unit, size ? "deg/h" : "min");
  }
  EXPECT_TRUE(d.fit.held_out.improves);
}

// No slope leads a fit to what stands in `step` alone, and a grid of hours leaves a remainder that
// a second effect would explain, or nothing would.
TEST(Diagnose, AnOnsetThatHasNoSlopeIsFoundToARowBeforeAnythingIsCalledForBesideIt) {
  const OwnTermsHeld held(own_term("ons", "drift.y", "A*step(t - C)",
                                   "A = { unit = 'deg/h', prior = 0.02 }, C = { unit = 'h', value "
                                   "= 6, grid = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11] }"));
  EXPECT_FALSE(has_slope(param("ons_C")));
  EXPECT_TRUE(has_slope(param("ons_A")));
  EXPECT_TRUE(has_slope(param("D_F_x"))) << "of the library";
  {
    const OwnTermsHeld steep(own_term("steep", "drift.y", "A*(1 + tanh((t - C)/S))/2*step(F - t)",
                                      "A = { unit = 'deg/h', prior = 0.02 }, C = { unit = 'h', "
                                      "value = 6 }, S = { unit = 'min', value = 1 }, F = { unit = "
                                      "'h', value = 9 }"));
    EXPECT_TRUE(has_slope(param("steep_C"))) << "though it is none but about 6 h";
    EXPECT_FALSE(has_slope(param("steep_F")));
  }
  const Timeline timeline = preset_timeline("twentyfour", CommandLaw::free, 1800.0, 60.0);
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active |= params_named("ons");
  for (const double size : {0.012, 0.04}) {
    TruthDraw draw = draw_truth(truth, timeline.chains, 22, 0);
    draw.theta[param("ons_A")] = size * deg_per_h;
    draw.theta[param("ons_C")] = 5.3 * 3600.0;
    const Readout readout;
    const Measurements measured = Simulator(truth, readout).run(timeline, draw, 22, 0).measured;
    const diagnosis::Diagnosis d =
        diagnosis::diagnose(base_filter(Coupling::eq5), {timeline, readout, measured}, {}, {}, {});
    ASSERT_EQ(d.verdict, diagnosis::Verdict::named) << report::sentence(d);
    ASSERT_EQ(d.causes.size(), 1u) << report::sentence(d);
    EXPECT_EQ(d.causes[0].term, "ons");
    for (const search::CauseParameter& p : d.causes[0].parameters) {
      const bool is_size = p.key == "ons_A";
      // A row of a minute is 0.017 h.
      EXPECT_NEAR(p.told(), is_size ? size : 5.3, 4.0 * p.sigma + (is_size ? 0.0 : 0.017)) << p.key;
      EXPECT_LT(p.sigma, is_size ? 0.1 * size : 0.1) << "not as wide as the grid: " << p.key;
    }
  }
}

}  // namespace
}  // namespace drift::own_term_diagnosed_test
