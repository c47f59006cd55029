// White noise that is hundreds of times as declared is no noise that agrees with a study.
#include <gtest/gtest.h>

#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::diagnosis::incredible_noise_test {
namespace {

/// Six positions whose accelerometers scatter by so many times what the study declares.
Diagnosis diagnosed(double times) {
  const mc::Study study = test::six_study();
  mc::Study noisy = study;
  noisy.readout.accelerometer_noise *= times;
  RecordingsOptions options;
  options.diagnose.starts = 1;
  options.diagnose.whiteness_draws = 0;
  options.diagnose.proposing = Proposing::left_out;
  options.advising = Advising::left_out;
  return diagnose_recordings(study, {test::simulated(noisy)}, options);
}

TEST(IncredibleNoise, IsNeverConsistent) {
  const Diagnosis d = diagnosed(300.0);
  EXPECT_EQ(d.verdict, Verdict::unexplained) << report::sentence(d);
  const auto* noise = remark_in<remark::IncredibleNoise>(d);
  ASSERT_NE(noise, nullptr) << report::sentence(d);
  EXPECT_EQ(noise->component, "accelerometer_white");
  EXPECT_GT(noise->factor, 200.0);
  EXPECT_EQ(report::diagnosis_in_brief(d).next.find("Next: look at the rows of the accelerometers"),
            0u)
      << report::diagnosis_in_brief(d).next;
}

TEST(IncredibleNoise, NoiseThatAStudyMayBeWrongByIsNoise) {
  const Diagnosis d = diagnosed(10.0);
  EXPECT_EQ(d.verdict, Verdict::consistent) << report::sentence(d);
  EXPECT_EQ(remark_in<remark::IncredibleNoise>(d), nullptr);
}

TEST(IncredibleNoise, TheChanceOfAFactorIsThatOfTheTailsOfItsPrior) {
  using inference::NoisePrior;
  EXPECT_NEAR(NoisePrior::chance_of_factor(1.0), 1.0 - NoisePrior::as_declared, 1e-15);
  // Student's t of three degrees has 5 % beyond 3.182446 on both sides.
  EXPECT_NEAR(NoisePrior::chance_of_factor(std::exp2(NoisePrior::usual)),
              0.05 * (1.0 - NoisePrior::as_declared), 1e-12);
  EXPECT_EQ(NoisePrior::chance_of_factor(4.0), NoisePrior::chance_of_factor(0.25));
}

}  // namespace
}  // namespace drift::diagnosis::incredible_noise_test
