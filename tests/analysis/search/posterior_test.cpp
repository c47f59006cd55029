// Probabilities of what a recording may be.
#include "analysis/search/posterior.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/inference/size_prior.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/short_study.hpp"

namespace drift::search::posterior_test {
namespace {

TEST(VisibleEvidence, IsTheEvidenceOfTheScalesThatATestCanSee) {
  // One amplitude of information 100: of the scales 1, 0.3, 0.1, ... of the prior's sigma the first
  // two are 10 and 3 sigma strong, the others 1 and less.
  const MatX C = MatX::Constant(1, 1, 100.0);
  const VecX g = VecX::Constant(1, 40.0);
  const auto of_scale = [&](double s) {
    const double grown = 1.0 + s * s * 100.0;
    return std::exp(0.5 * s * s * 1600.0 / grown) / std::sqrt(grown);
  };
  const inference::VisibleEvidence seen = inference::evidence_of_visible_sizes(C, g);
  EXPECT_NEAR(seen.share, 0.4, 1e-12);
  EXPECT_NEAR(seen.log, std::log((of_scale(1.0) + of_scale(0.3)) / 2.0), 1e-12);
  const inference::VisibleEvidence none =
      inference::evidence_of_visible_sizes(MatX::Constant(1, 1, 8.9), g);
  EXPECT_EQ(none.share, 0.0);
  EXPECT_TRUE(std::isinf(none.log));
  EXPECT_NEAR(inference::evidence_of_visible_sizes(MatX::Constant(1, 1, 9.1), g).share, 0.2, 1e-12);
}

TEST(EvidenceOfUnknownSize, IsTheIntegralOverSizesForOneAmplitudeAndForTwo) {
  for (const double z : {6.0, 15.0}) {
    double one = 0.0, two = 0.0;
    const double least = inference::VisibleLimits::size, step = 1e-3;
    for (double a = least + 0.5 * step; a < std::min(100.0 * least, z + 12.0); a += step) {
      const double weight = step / (a * std::log(100.0)) * std::exp(-0.5 * (a * a + z * z));
      one += weight * std::cosh(a * z);
      two += weight * std::cyl_bessel_i(0.0, a * z);
    }
    // The slow factors vary by 1 / z^2 over the integrand: 1 and 2 powers of a.
    EXPECT_NEAR(inference::log_evidence_of_unknown_size(z * z) - 0.5 * z * z, std::log(one),
                1.5 / (z * z));
    EXPECT_NEAR(inference::log_evidence_of_unknown_size(z * z, 2) - 0.5 * z * z, std::log(two),
                4.0 / (z * z));
  }
}

diagnosis::Probabilities of(const mc::Study& study, std::uint64_t run) {
  const Timeline timeline = lay_out(study.plan, study.site);
  const TruthDraw draw = draw_truth(study.truth, timeline.chains, study.monte_carlo.seed, run);
  const Recording recording = make_recording(timeline,
                                             Simulator(study.truth, study.readout)
                                                 .run(timeline, draw, study.monte_carlo.seed, run)
                                                 .measured,
                                             study.readout);
  diagnosis::DiagnoseOptions options;
  options.folds = diagnosis::FoldMethod::linear;
  options.starts = 1;
  return diagnosis::diagnose(study, {recording}, options).probabilities;
}

double total(const diagnosis::Probabilities& p) {
  double sum = p.consistent + p.noise_only + p.outside;
  for (const auto& e : p.named) sum += e.probability;
  return sum;
}

mc::Study small(mc::Overrides more) {
  const std::string terms = "[\"fixed_drift\", \"g_drift\"]";
  mc::Overrides sets{{"plan.preset", "six"},          {"plan.dwell", "30 min"},
                     {"plan.sample", "120 s"},        {"truth.terms", terms},
                     {"filter.nominal.terms", terms}, {"filter.nominal.coupling", "eq5"}};
  sets.insert(sets.end(), more.begin(), more.end());
  return mc::read_study(DRIFT_SOURCE_DIR "/configs/diagnose_equation.toml", sets);
}

TEST(Posterior, IsThePriorWhereAllExplainTheDataAlike) {
  // As stated in diagnose.md: nothing 0.5, of which the noise is as declared in 0.8; the library
  // 0.45, of which the second cause is three times as probable as the first; outside 0.05.
  const Evidence alike{
      .declared = std::log(0.8) - 700.0,
      .estimated = std::log(0.2) - 700.0,
      .outside = -700.0,
      .library = {{{{1, 0}}, std::log(0.25) - 700.0}, {{{2, 0}}, std::log(0.75) - 700.0}}};
  const Posterior p = posterior_of(alike);
  EXPECT_NEAR(p.consistent, 0.4, 1e-12);
  EXPECT_NEAR(p.noise_only, 0.1, 1e-12);
  EXPECT_NEAR(p.outside, 0.05, 1e-12);
  ASSERT_EQ(p.named.size(), 2u);
  EXPECT_EQ(p.named[0].choices.front().candidate, 2u);
  EXPECT_NEAR(p.named[0].probability, 0.45 * 0.75, 1e-12);
  EXPECT_NEAR(p.named[1].probability, 0.45 * 0.25, 1e-12);
}

TEST(Posterior, SumsToOneAndSaysNothingIsMissingWhereNothingIs) {
  const mc::Study study = small({});
  double consistent = 0.0;
  for (std::uint64_t run = 0; run < 5; ++run) {
    const diagnosis::Probabilities p = of(study, run);
    EXPECT_NEAR(total(p), 1.0, 1e-12);
    consistent += p.consistent / 5.0;
  }
  EXPECT_GT(consistent, 0.8);
}

TEST(Posterior, NoiseThatIsNotAsDeclaredIsNoEffect) {
  const mc::Study study = small({{"truth.drift_random_walk", "0.02 deg/h/sqrt(h)"}});
  const diagnosis::Probabilities p = of(study, 0);
  EXPECT_NEAR(total(p), 1.0, 1e-12);
  EXPECT_GT(p.noise_only, p.consistent);
  EXPECT_GT(p.noise_only, 0.5);
}

TEST(Posterior, AnEffectOfTwentySigmaIsNearlyCertain) {
  const mc::Study study = small({{"truth.terms+", "drift_ramp"},
                                 {"truth.parameters.ramp_x", "0 deg/h/h"},
                                 {"truth.parameters.ramp_y", "0.01 deg/h/h"},
                                 {"truth.parameters.ramp_z", "0 deg/h/h"}});
  const diagnosis::Probabilities p = of(study, 0);
  EXPECT_NEAR(total(p), 1.0, 1e-12);
  EXPECT_LT(p.consistent + p.noise_only, 1e-6);
  ASSERT_FALSE(p.named.empty());
  EXPECT_EQ(p.named.front().causes.front().term, "drift_ramp");
}

}  // namespace
}  // namespace drift::search::posterior_test
