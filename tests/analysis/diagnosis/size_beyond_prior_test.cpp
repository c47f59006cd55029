// An effect far larger than the library believes, which the test sees no better than the library
// does: its prior takes half of it, and what is stated is what the data say.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::size_beyond_prior_test {
namespace {

using namespace drift::test;

/// The diagnosis of a hang-off of the outer gimbal alone [arcsec].
Diagnosis of_hang_off(double arcsec) {
  const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 3600.0, 120.0);
  TruthSpec truth = base_truth(Coupling::eq6);
  truth.active |= params_named("hang_off");
  const Readout readout;
  TruthDraw draw = draw_truth(truth, timeline.chains, 5, 0);
  for (const char* key : {"H_middle", "H_inner", "H_u_x", "H_u_y", "H_u_z"})
    draw.theta[param(key)] = 0.0;
  draw.theta[param("H_outer")] = arcsec * TermLibrary::specs[param("H_outer")].unit.to_si;
  const Measurements measured = Simulator(truth, readout).run(timeline, draw, 5, 0).measured;
  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.whiteness_draws = 0;
  return diagnose(base_filter(Coupling::eq6), {timeline, readout, measured}, {}, {}, options);
}

TEST(SizeBeyondPrior, IsStatedAsTheDataHaveItAndCalledUnusual) {
  constexpr double truth = 60.0;  // of a prior of 5
  const Diagnosis d = of_hang_off(truth);
  const std::string said = report::sentence(d);
  ASSERT_EQ(d.causes.size(), 1u) << said;
  ASSERT_EQ(d.causes.front().parameters.size(), 1u) << said;
  const search::CauseParameter& p = d.causes.front().parameters.front();
  EXPECT_EQ(p.key, "H_outer") << said;
  EXPECT_LT(std::abs(p.value - truth), 3.0 * p.sigma) << said;
  // The case in question: its prior alone would hold back a quarter of it and more.
  EXPECT_GT(p.sigma, 2.9) << said;
  EXPECT_NE(said.find("times its usual size"), std::string::npos) << said;
}

}  // namespace
}  // namespace drift::diagnosis::size_beyond_prior_test
