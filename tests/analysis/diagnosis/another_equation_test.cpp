// Another equation as an answer: what it is weighed against, and which lambda is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/sentence.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/program.hpp"

namespace drift::diagnosis::another_equation_test {
namespace {

using namespace drift::test;

mc::Study study_of(const std::string& text) {
  const ScratchFolder scratch;
  return mc::read_study(scratch.write("study.toml", text));
}

Diagnosis diagnosed(const mc::Study& study, std::uint64_t seed, std::uint64_t run) {
  const Timeline timeline = lay_out(study.plan, study.site);
  const TruthDraw draw = draw_truth(study.truth, timeline.chains, seed, run);
  const Measurements measured =
      Simulator(study.truth, study.readout).run(timeline, draw, seed, run).measured;
  return diagnose(study.filters.front(), {timeline, study.readout, measured}, {}, {}, {});
}

/// Eight positions; the warm-up of all gyros in the filter takes up most of a ramp.
constexpr const char* two_effects = R"toml(schema = 1
[site]
latitude = "-33.9 deg"
[plan]
dwell = "30 min"
sample = "30 s"
mode = "free"
[[plan.position]]
axes = "x=N y=W z=U"
[[plan.position]]
axes = "x=N y=E z=D"
[[plan.position]]
axes = "x=U y=N z=W"
[[plan.position]]
axes = "x=D y=N z=E"
[[plan.position]]
axes = "x=W y=U z=N"
case_heading = "45 deg"
[[plan.position]]
axes = "x=E y=D z=N"
case_heading = "45 deg"
[[plan.position]]
axes = "x=N y=UW z=UE"
[[plan.position]]
axes = "x=UN y=W z=US"
[readout]
accelerometer_noise = "10 ug"
gimbal_noise = "8 arcsec"
[truth]
coupling = "eq6"
terms = ["fixed_drift", "g_drift", "gyro_misalignment", "accelerometer",
         "cubic_g_drift.y", "drift_ramp.z", "warmup_drift.x"]
[truth.parameters]
D_III_y = "0.05 deg/h/g^3"
ramp_z = "0.02 deg/h/h"
W_x = "0.2 deg/h"
[[filter]]
name = "nominal"
coupling = "eq6"
terms = ["fixed_drift", "g_drift", "gyro_misalignment", "accelerometer", "warmup_drift"]
)toml";

TEST(AnotherEquation, WithAnEffectIsWeighedAgainstTwoEffects) {
  const mc::Study study = study_of(two_effects);
  for (const std::uint64_t seed : {6u, 11u}) {
    const Diagnosis d = diagnosed(study, seed, 0);
    for (const search::Cause& c : d.causes)
      printf("%d %s.%s p %g set %d\n", (int)seed, c.term.c_str(), c.axis.c_str(), c.probability,
             c.set);
  }
}

constexpr const char* no_misalignment = R"toml(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "twelve"
dwell = "60 min"
sample = "3 min"
mode = "free"
[readout]
accelerometer_noise = "5 ug"
gimbal_noise = "5 arcsec"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "g_drift", "gyro_misalignment"]
drift_random_walk = "0.002 deg/h/sqrt(h)"
[truth.parameters]
eta = "0 arcsec"
xi = "0 arcsec"
[[filter]]
name = "nominal"
coupling = "eq5"
terms = ["fixed_drift", "g_drift", "gyro_misalignment"]
)toml";

TEST(AnotherEquation, HasALambdaWithinItsInterval) {
  const mc::Study study = study_of(no_misalignment);
  for (const std::uint64_t run : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const Diagnosis d = diagnosed(study, 3, run);
    printf("%d %s\n", (int)run, report::sentence(d).c_str());
  }
}

TEST(GrossMisfit, IsNoneWhereARandomWalkOfAUsualSizeExplainsIt) {
  mc::Study study = study_of(no_misalignment);
  study.truth.noise.drift_random_walk = 0.01 * unit::deg_per_h_per_sqrt_h.to_si;
  for (const std::uint64_t run : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const Diagnosis d = diagnosed(study, 5, run);
    printf("%d %s chi2 %g\n", (int)run, report::sentence(d).c_str(), d.fit.chi2_per_dof_before);
  }
}

}  // namespace
}  // namespace drift::diagnosis::another_equation_test
