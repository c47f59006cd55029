// Another equation as an answer: what it is weighed against, and which lambda is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/inference/misalignments.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
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

bool holds(const Diagnosis& d, int set, std::string_view term, std::string_view axis) {
  return std::ranges::any_of(d.causes, [&](const search::Cause& c) {
    return c.set == set && c.term == term && c.axis == axis;
  });
}

TEST(AnotherEquation, WithAnEffectIsWeighedAgainstTwoEffects) {
  const mc::Study study = study_of(two_effects);
  for (const std::uint64_t seed : {6u, 11u}) {
    const Diagnosis d = diagnosed(study, seed, 0);
    bool found = false;
    for (int set = 0; set < 3; ++set) {
      EXPECT_FALSE(holds(d, set, "frame_closure", "")) << report::sentence(d);
      found = found || (holds(d, set, "drift_ramp", "z") && holds(d, set, "cubic_g_drift", "y"));
    }
    EXPECT_TRUE(found) << report::sentence(d);
  }
}

/// A plan that shows misalignments under eq. (5) and hides them under eq. (6).
constexpr const char* twelve = R"toml(schema = 1
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
[[filter]]
name = "nominal"
coupling = "eq5"
terms = ["fixed_drift", "g_drift", "gyro_misalignment"]
)toml";

/// The misalignments of the truth as large as this part of their prior in the filter.
mc::Study aligned_to(double part) {
  mc::Study study = study_of(twelve);
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (inference::is_misalignment(i))
      study.truth.priors[i] = normal(0.0, part * study.filters.front().priors[i].sigma());
  return study;
}

// With misalignments of the size of their prior for certain, the first is "named: lambda = 0.97".
TEST(AnotherEquation, IsNotFoundOnAWellAlignedPlatform) {
  const mc::Study study = aligned_to(0.05);
  for (const std::uint64_t run : {1u, 3u}) {
    const Diagnosis d = diagnosed(study, 3, run);
    EXPECT_EQ(d.verdict, Verdict::consistent) << report::sentence(d);
  }
}

TEST(AnotherEquation, IsNotFoundWhereNothingIsMisalignedAndDriftWalks) {
  mc::Study study = aligned_to(1e-6);
  study.truth.noise.drift_random_walk = 0.002 * unit::deg_per_h_per_sqrt_h.to_si;
  for (const std::uint64_t run : {1u, 2u}) {
    const Diagnosis d = diagnosed(study, 3, run);
    EXPECT_EQ(d.verdict, Verdict::consistent) << report::sentence(d);
  }
}

TEST(AnotherEquation, HasALambdaWithinItsInterval) {
  mc::Study study = study_of(twelve);
  study.filters.front().coupling = Coupling::eq6;
  for (const std::uint64_t run : {1u, 2u, 3u}) {
    const Diagnosis d = diagnosed(study, 3, run);
    ASSERT_FALSE(d.causes.empty());
    ASSERT_EQ(d.causes.front().term, "frame_closure") << report::sentence(d);
    const search::CauseParameter& lambda = d.causes.front().parameters.front();
    EXPECT_LT(lambda.low(), lambda.value);
    EXPECT_GT(lambda.high(), lambda.value);
    EXPECT_LT(std::abs(lambda.value), 4.0 * lambda.sigma);  // eq. (5)
  }
}

TEST(AnotherEquation, IsSettledWhereTheTestExcludesTheNominalOneAlone) {
  // In free drift with short dwells any lambda does as well as 0 up to where misalignments would be
  // too large: its sigma is as good as that of its prior, and eq. (6) is out of the question.
  mc::Study study = study_of(twelve);
  study.filters.front().coupling = Coupling::eq6;
  study.plan.positions.resize(6);
  for (const std::uint64_t run : {1u, 2u, 3u, 4u}) {
    const Diagnosis d = diagnosed(study, 5, run);
    ASSERT_FALSE(d.causes.empty());
    ASSERT_EQ(d.causes.front().term, "frame_closure") << report::sentence(d);
    for (const Remark& r : d.remarks)
      EXPECT_FALSE(std::holds_alternative<remark::LambdaNotSettled>(r)) << report::sentence(d);
    const search::CauseParameter& lambda = d.causes.front().parameters.front();
    EXPECT_LT(lambda.low(), 0.0) << report::sentence(d);
    EXPECT_LT(lambda.high(), 1.0);
  }
}

TEST(GrossMisfit, IsNoneWhereARandomWalkOfAUsualSizeExplainsIt) {
  mc::Study study = study_of(twelve);
  study.truth.noise.drift_random_walk = 0.01 * unit::deg_per_h_per_sqrt_h.to_si;
  double gross = 0.0;
  for (const std::uint64_t run : {4u, 6u}) {
    const Diagnosis d = diagnosed(study, 3, run);
    EXPECT_EQ(d.verdict, Verdict::consistent) << report::sentence(d);
    gross = std::max(gross, d.fit.chi2_per_dof_before);
  }
  EXPECT_GT(gross, inference::SampleLimits::gross);
}

}  // namespace
}  // namespace drift::diagnosis::another_equation_test
