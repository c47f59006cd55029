// A drift that differs from caging to caging is noise of a kind of its own, not physics.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/blind/noise_faults.hpp"
#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::caging_drift_test {
namespace {

using namespace drift::test;

Diagnosis diagnosis_of(std::string_view preset, Coupling coupling, std::uint64_t seed,
                       double& sigma) {
  blind::World world;
  world.truth = base_truth(coupling);
  world.timeline = preset_timeline(preset, CommandLaw::free, 1800.0, 120.0);
  world.draw = draw_truth(world.truth, world.timeline.chains, seed, 0);
  Stream stream(seed, 0, Purpose::test);
  const blind::HiddenEffect hidden =
      blind::spoil_noise(blind::noise_fault("caging_drift"), world, stream);
  EXPECT_EQ(hidden.term, "caging_drift");
  sigma = hidden.parameters.front().value;
  const Measurements measured = blind::simulate_recorded(world, seed, 0).measured;
  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.whiteness_draws = 0;
  return diagnose(base_filter(coupling), {world.timeline, world.readout, measured}, {}, {},
                  options);
}

TEST(CagingDrift, IsFoundWithItsSizeAndNothingElseIs) {
  struct Case {
    const char* preset;
    Coupling coupling;
    std::uint64_t seed;
    double cagings;
  };
  for (const Case& c : {Case{"twelve", Coupling::eq6, 81, 12.0},
                        {"twelve", Coupling::eq5, 82, 12.0},
                        {"twentyfour", Coupling::eq5, 83, 24.0}}) {
    SCOPED_TRACE(c.seed);
    double sigma = 0.0;
    const Diagnosis d = diagnosis_of(c.preset, c.coupling, c.seed, sigma);
    EXPECT_EQ(d.verdict, Verdict::consistent) << report::diagnosis_in_brief(d).verdict;
    const auto found = std::ranges::find_if(d.noise, [](const inference::NoiseFinding& f) {
      return f.component == "caging_drift" && f.significant;
    });
    ASSERT_NE(found, d.noise.end());
    // Three of each caging, of which the fixed drift takes one: four sigma of their scatter.
    EXPECT_NEAR(found->value / sigma, 1.0, 4.0 / std::sqrt(2.0 * 3.0 * (c.cagings - 1.0)));
    EXPECT_NE(report::diagnosis_in_brief(d).verdict.find("from caging to caging"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace drift::diagnosis::caging_drift_test
