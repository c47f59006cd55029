// Noise that a diagnosis found goes into the patched study: with it the fit is one of the noise.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/starts.hpp"
#include "core/sim/simulate.hpp"
#include "tests/analysis/report/diagnosis/diagnosis_fixture.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::patched_noise_test {
namespace {

using test::nominal_study;
using test::read_text;

inference::NoiseFinding finding(const char* component, double factor, double value,
                                const char* unit, bool significant = true) {
  inference::NoiseFinding f;
  f.component = component;
  f.factor = factor;
  f.value = value;
  f.unit = unit;
  f.significant = significant;
  return f;
}

TEST(PatchedNoise, ReadsBackAsWhatWasFoundOfWhatCanBeDeclared) {
  const test::ScratchFolder folder;
  const mc::Study study = read_text(folder, "s.toml", nominal_study);
  const std::vector<inference::NoiseFinding> found{
      finding("accelerometer_white", 1.5, 0.0, ""),
      finding("gimbal_white", 0.8, 0.0, "", false),
      finding("angle_random_walk", std::nan(""), 0.0021, "deg/sqrt(h)"),
      finding("drift_random_walk", 2.0, 0.04, "deg/h/sqrt(h)"),
      finding("markov_drift", std::nan(""), 0.01, "deg/h"),
      finding("outliers", std::nan(""), 3.0, "samples")};
  const mc::Study again = read_text(folder, "again.toml", study_with_noise(study, found));
  EXPECT_NEAR(again.readout.accelerometer_noise, 1.5 * study.readout.accelerometer_noise, 1e-12);
  EXPECT_EQ(again.readout.gimbal_noise, study.readout.gimbal_noise) << "not significant";
  const auto& noise = again.filters.front().noise;
  EXPECT_NEAR(noise.angle_random_walk, 0.0021 * unit::deg_per_sqrt_h.to_si, 1e-12);
  EXPECT_NEAR(noise.drift_random_walk, 0.04 * unit::deg_per_h_per_sqrt_h.to_si, 1e-15);
  EXPECT_EQ(again.filters.back().noise.drift_random_walk, noise.drift_random_walk)
      << "a walk is of the unit, whatever equation it is described by";
  const FilterSpec& nominal = study.filters.front();
  EXPECT_FALSE(can_be_declared(found[4], RecordingKind::platform, nominal)) << "no key for it";
  EXPECT_FALSE(can_be_declared(found[0], RecordingKind::strapdown, nominal));
  Diagnosis d;
  d.nominal = nominal;
  d.noise = found;
  EXPECT_EQ(not_declared(d), std::vector<std::string>{"markov_drift 0.01 deg/h"});
  d.has_patch = true;
  EXPECT_TRUE(declares_noise(d));
}

TEST(PatchedNoise, AWalkIsNotDeclaredTwice) {
  const test::ScratchFolder folder;
  const mc::Study study = read_text(folder, "s.toml",
                                    std::string(nominal_study) +
                                        "[[filter]]\nname = \"walks\"\ncoupling = \"eq5\"\n"
                                        "terms = [\"fixed_drift\", \"drift_random_walk\"]\n"
                                        "[[filter]]\nname = \"has its own\"\ncoupling = \"eq5\"\n"
                                        "drift_random_walk = \"0.003 deg/h/sqrt(h)\"\n");
  const auto walk = finding("drift_random_walk", std::nan(""), 0.04, "deg/h/sqrt(h)");
  const mc::Study again = read_text(folder, "again.toml", study_with_noise(study, {walk}));
  EXPECT_GT(again.filters[0].noise.drift_random_walk, 0.0);
  EXPECT_EQ(again.filters[2].noise.drift_random_walk, 0.0) << "its term has one";
  EXPECT_EQ(again.filters[3].noise.drift_random_walk, study.filters[3].noise.drift_random_walk)
      << "declared otherwise on purpose";
  EXPECT_FALSE(can_be_declared(walk, RecordingKind::platform, study.filters[2]));
}

/// A test of a unit of the nominal model with resolvers of three times the declared noise and gyros
/// of a random walk that nobody declared.
TEST(PatchedNoise, WithItTheFitIsOneOfTheNoise) {
  const test::ScratchFolder folder;
  const mc::Study study =
      read_text(folder, "s.toml",
                "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = \"twelve\"\ndwell "
                "= \"30 min\"\nsample = \"60 s\"\n"
                "mode = \"free\"\n[[filter]]\nname = \"nominal\"\ncoupling = \"eq5\"\n");
  const FilterSpec nominal = study.filters.front();
  TruthSpec unit_of_test;
  static_cast<ModelSpec&>(unit_of_test) = nominal;
  unit_of_test.noise.angle_random_walk = 0.004 * unit::deg_per_sqrt_h.to_si;
  Readout coarse = study.readout;
  coarse.gimbal_noise *= 3.0;
  const Timeline timeline = test::preset_timeline("twelve", CommandLaw::free, 1800.0, 60.0);
  const Measurements measured = Simulator(unit_of_test, coarse).run(timeline, 19, 0).measured;

  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.whiteness_draws = 0;
  const Diagnosis d = diagnose(nominal, {timeline, study.readout, measured}, {}, {}, options);
  ASSERT_EQ(d.verdict, Verdict::consistent);
  ASSERT_TRUE(declares_noise(d));
  EXPECT_NE(report::diagnosis_in_brief(d).next.find("patched.toml"), std::string::npos);

  const mc::Study patched = read_text(folder, "patched.toml", study_with_noise(study, d.noise));
  EXPECT_NEAR(patched.readout.gimbal_noise / coarse.gimbal_noise, 1.0, 4.0 / std::sqrt(2160.0))
      << "four sigma of its 1,080 readings";
  const auto score = [&](const mc::Study& s) {
    const BatchResult fit = fit_batch(s.filters.front(), {timeline, s.readout, measured},
                                      initial_estimate(s.filters.front(), 0, 0));
    return std::pair{fit.estimate.statistic, static_cast<double>(fit.estimate.measured)};
  };
  const auto [before, rows] = score(study);
  const auto [after, same] = score(patched);
  EXPECT_GT(before, 2.0 * rows);
  // Scatter of chi-square, and of it as the noise is known to 3 digits and from these rows.
  EXPECT_NEAR(after / same, 1.0, 4.0 * std::sqrt(2.0 / same) + 0.01);
}

}  // namespace
}  // namespace drift::diagnosis::patched_noise_test
