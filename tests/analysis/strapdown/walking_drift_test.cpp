// A drift that is declared to walk counts in what identify says.
#include "analysis/strapdown/walking_drift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/strapdown/case_report.hpp"
#include "analysis/strapdown/case_diagnose.hpp"
#include "analysis/strapdown/sensed.hpp"
#include "tests/support/program.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::walking_drift_test {
namespace {

constexpr double walk = 600.0;  // [deg/h/sqrt(h)]

mc::Study study_with(const std::string& noise) {
  return mc::read_study_text(test::strapdown_study("45 deg", "9.8 m/s^2") + noise, "study.toml");
}

mc::Study declared() {
  return study_with("drift_random_walk = \"600 deg/h/sqrt(h)\"\n");
}

Theta truth() {
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) test::set(theta, key, 900.0);
  test::set(theta, "s_y", 3000.0);
  return theta;
}

/// Twenty rests and turns of 6 s; the drift of every gyro walks from the start on.
Recording walking(std::uint64_t seed) {
  Recording r = test::strapdown_recording(
      {.dwells = 20, .rest = 4.0, .gyro_noise = 2e-4, .seed = seed}, truth());
  Stream stream(seed, 0, Purpose::test, 9);
  const double q = walk * unit::deg_per_h_per_sqrt_h.to_si;
  for (int a = 0; a < 3; ++a) {
    double drift = 0.0;
    for (double& v : r.channels[static_cast<std::size_t>(1 + a)].values) {
      drift += q * std::sqrt(0.01) * stream.normal();
      v += drift;
    }
  }
  return r;
}

TEST(WalkingDrift, DeclaredItIsInChiSquareAndInTheSigmas) {
  double squares = 0.0, narrow = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Recording r = walking(seed);
    const CaseIdentification without = identify_case(study_with(""), case_study(study_with(""), r)),
                             with = identify_case(declared(), case_study(declared(), r));
    const EstimateResult &is = with.fits.front().fit.estimate,
                         &was = without.fits.front().fit.estimate;
    EXPECT_TRUE(identification::misfit(was)) << seed;
    EXPECT_FALSE(identification::misfit(is)) << seed << ": " << is.statistic_per_dof();
    const auto pull = [&](const EstimateResult& e) {
      const EstimateResult sensed = as_sensed(e);
      const ParameterEstimate* p = sensed.find(*TermLibrary::find("D_F_x"));
      return (p->value - truth()[static_cast<Eigen::Index>(p->param)]) / p->sigma;
    };
    squares += std::pow(pull(is), 2);
    narrow += std::pow(pull(was), 2);
  }
  // Chi-square of eight: 20 at most in 99 of 100 such tests.
  EXPECT_LT(squares, 20.1);
  EXPECT_GT(narrow, 100.0);
}

TEST(WalkingDrift, WithoutOneTheFitIsAsItWas) {
  const mc::Study study = study_with("");
  const CaseStudy of = case_study(study, walking(1));
  const FilterSpec filter = case_filter(study.filters.front(), of);
  const BatchResult fit = fit_batch(filter, of.measured(), start_of(filter, of));
  const EstimateResult same = under_walk(filter, of.measured(), fit);
  EXPECT_EQ(same.statistic, fit.estimate.statistic);
  EXPECT_EQ(same.covariance, fit.estimate.covariance);
}

TEST(WalkingDrift, OfOneThatIsTinyTheGeneralisedFitIsTheFit) {
  mc::Study study = declared();
  study.filters.front().noise.drift_random_walk *= 1e-9;
  const CaseStudy of = case_study(study, walking(2));
  const FilterSpec filter = case_filter(study.filters.front(), of);
  const BatchResult fit = fit_batch(filter, of.measured(), start_of(filter, of));
  const EstimateResult same = under_walk(filter, of.measured(), fit);
  EXPECT_NEAR(same.statistic, fit.estimate.statistic, 1e-3 * fit.estimate.statistic);
  for (std::size_t k = 0; k < same.parameters.size(); ++k) {
    const ParameterEstimate &a = same.parameters[k], &b = fit.estimate.parameters[k];
    EXPECT_NEAR(a.value, b.value, 0.01 * b.sigma) << k;
    EXPECT_NEAR(a.sigma, b.sigma, 1e-3 * b.sigma) << k;
  }
}

TEST(WalkingDrift, DiagnoseSaysWhatIdentifyIsToBeTold) {
  const mc::Study study = study_with("");
  const CaseIdentification id = identify_case(study, case_study(study, walking(1)));
  const std::string next = report::case_report(study, id).brief.next;
  EXPECT_NE(next.find("what is missing, in the model or in the noise"), std::string::npos) << next;
  const diagnosis::Diagnosis d = diagnose_case(study, id);
  EXPECT_EQ(d.verdict, diagnosis::Verdict::consistent);
  const std::string then = report::diagnosis_in_brief(d).next;
  EXPECT_NE(then.find("identify with patched.toml"), std::string::npos) << then;
  const test::ScratchFolder folder;
  const mc::Study patched =
      mc::read_study(folder.write("patched.toml", diagnosis::study_with_noise(study, d.noise)));
  EXPECT_GT(patched.filters.front().noise.drift_random_walk, 0.0);
}

}  // namespace
}  // namespace drift::strapdown::walking_drift_test
