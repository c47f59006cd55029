// Limits of analysis/inference/thresholds.hpp that a stage of the diagnosis applies, met from both
// sides.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/diagnosis/asides.hpp"
#include "analysis/diagnosis/doubts/wrong_priors.hpp"
#include "analysis/diagnosis/judge.hpp"
#include "analysis/identification/spikes.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::thresholds_test {
namespace {

using test::param;

/// Whether one sample `size` away from quiet neighbours, whose range is `range`, is taken out. The
/// others scatter so that the instrument's noise is `noise` times as declared.
bool is_spike(double size, double range = 0.0, double noise = 1.0, bool in_turn = false,
              int at = 50, int also_at = -1) {
  constexpr int n = 100;
  Timeline timeline;
  timeline.intervals.resize(n);
  if (in_turn) timeline.intervals[at].turn = CaseTurn{};
  BatchResult fit;
  fit.acc_residual = Mat3X::Zero(3, n);
  // a a -a -a a a ...: each is 2 a from the median of its four neighbours, which for normal noise
  // is 0.6745 of its sigma times 1.14 at the median. Around the sample it is quiet.
  const double a = 0.5 * noise * 0.6745 * 1.14;
  for (int k = 0; k < n; ++k)
    if (std::abs(k - at) > 4) fit.acc_residual.col(k).setConstant(k % 4 < 2 ? a : -a);
  fit.acc_residual(0, at) = size;
  if (range != 0.0) {  // without the neighbour that is farthest away, and about one median
    fit.acc_residual(0, at - 2) = range;
    fit.acc_residual(0, at + 2) = -range;
  }
  if (also_at >= 0) {  // a second dwell begins as the first one does
    for (int k = also_at; k < n; ++k) timeline.intervals[k].position = 1;
    fit.acc_residual.middleCols(also_at, 5).setZero();
    fit.acc_residual(0, also_at) = size;
  }
  Readout readout;
  readout.gimbals = false;
  Measurements measured{Mat3X::Zero(3, n), Mat3X::Zero(3, n)};
  const auto clean = identification::without_spikes(measured, timeline, readout, fit);
  return std::isnan(clean.measured.acc(0, at));
}

TEST(Thresholds, ASpikeIsEightSigmaAndTwoRangesAway) {
  EXPECT_FALSE(is_spike(7.9));
  EXPECT_TRUE(is_spike(8.1));
  EXPECT_FALSE(is_spike(9.9, 1.0));
  EXPECT_TRUE(is_spike(10.1, 1.0));
  // Noise that is more than declared is the measure; less is not.
  EXPECT_FALSE(is_spike(9.5, 0.0, 1.2));
  EXPECT_TRUE(is_spike(9.7, 0.0, 1.2));
  EXPECT_FALSE(is_spike(12.3, 0.0, 1.55));
  EXPECT_TRUE(is_spike(12.5, 0.0, 1.55));
  EXPECT_FALSE(is_spike(7.9, 0.0, 0.5));
  // A row that was read in a turn stands beside others that were read at another rate.
  EXPECT_FALSE(is_spike(100.0, 0.0, 1.0, true));
  // The ends of a dwell have their neighbours on one side.
  for (const int at : {0, 1, 98, 99}) {
    EXPECT_FALSE(is_spike(7.9, 0.0, 1.0, false, at)) << at;
    EXPECT_TRUE(is_spike(8.1, 0.0, 1.0, false, at)) << at;
  }
  EXPECT_FALSE(is_spike(100.0, 0.0, 1.0, false, 0, 60)) << "every dwell begins so";
}

TEST(Thresholds, ParametersFartherFromTheirPriorsThanAnyWouldBeAreSaid) {
  // 0.02 / 40 is the chance of a normal number beyond 3.48 sigma, on either side.
  const auto beyond = [](double sigmas) {
    FilterSpec nominal;
    search::Fitted found;
    BatchResult& fit = found.fit;
    for (std::size_t k = 0; k < 40; ++k) {
      nominal.active.set(k);
      nominal.priors[k] = normal(1.0, 2.0);
      ParameterEstimate p;
      p.param = k;
      p.prior_mean = p.value = 1.0;
      p.prior_sigma = 2.0;
      fit.estimate.parameters.push_back(p);
    }
    fit.estimate.parameters[7].value = 1.0 - 2.0 * sigmas;
    return beyond_prior(nominal, found, inference::SearchLimits::alpha);
  };
  EXPECT_FALSE(beyond(3.47));
  const auto found = beyond(3.49);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->parameters.size(), 1u);
  EXPECT_EQ(found->parameters[0].estimate.param, 7u);
  EXPECT_EQ(found->of, 40u);
  EXPECT_NEAR(found->farthest().sigmas, 3.49, 1e-9);
  EXPECT_NEAR(found->farthest().chance, 40.0 * std::erfc(3.49 / std::sqrt(2.0)), 1e-9);
}

TEST(Thresholds, AnEquationIsOpenUpToOddsOfNinetyToOne) {
  const auto open = [](double gain) {
    Diagnosis d;
    d.nominal.coupling = Coupling::eq6;
    d.other_equation_gain = gain;
    return equation_against_other(d).value().open();
  };
  EXPECT_TRUE(open(-2.0 * std::log(89.0)));
  EXPECT_FALSE(open(-2.0 * std::log(91.5)));
}

TEST(Thresholds, TheNearestKnownExplainsATwentiethOfTheMisfit) {
  const auto with_chi2 = [](double per_dof) {
    search::Fitted e;
    e.fit.estimate.measured = 1000;
    e.fit.estimate.statistic = 1000.0 * per_dof;
    return e;
  };
  const auto known = [&](double after) {
    search::Search found;
    found.rejected.emplace_back();
    found.rejected.back().after = with_chi2(after);
    return nearest_known(with_chi2(2.0), found).has_value();
  };
  EXPECT_FALSE(known(1.96));
  EXPECT_TRUE(known(1.94));
}

/// Of something significant, with a cause that fits or without; noise: probability that nothing is
/// missing.
Verdict verdict_of(double noise, bool cause, bool noise_competes, double member_gain = 2.0,
                   double wrong_priors = 0.0) {
  search::Search found;
  found.significant = true;
  if (cause) found.sets.emplace_back();
  if (noise_competes) found.noise_alone.emplace();
  search::Posterior posterior;
  posterior.consistent = 0.0;
  posterior.noise_only = noise;
  posterior.wrong_priors = wrong_priors;
  posterior.outside = 1.0 - noise - wrong_priors;
  HeldOut held_out;
  held_out.folds.resize(6);
  held_out.improves = true;
  return judge({}, found, posterior, held_out, {2.0, member_gain}, NamedBy::held_out).verdict;
}

TEST(Thresholds, EachOfSeveralCausesMustBringOneOfLogScore) {
  EXPECT_EQ(verdict_of(0.0, true, false, 0.99), Verdict::ambiguous);
  EXPECT_EQ(verdict_of(0.0, true, false, 1.01), Verdict::named);
}

TEST(Thresholds, ThatWholeRecordingsAreNotPredictedIsNotSaidOfPositions) {
  search::Search found;
  found.significant = true;
  found.sets.emplace_back();
  search::Posterior posterior;
  posterior.consistent = posterior.noise_only = 0.0;
  posterior.outside = 1.0;
  for (const bool recordings : {true, false}) {
    HeldOut held_out;
    held_out.folds.resize(6);
    held_out.recordings_disagree = recordings;
    const Judged judged = judge({}, found, posterior, held_out, {}, NamedBy::held_out);
    EXPECT_EQ(judged.verdict, Verdict::ambiguous);
    ASSERT_EQ(judged.remarks.size(), 1u);
    const auto* remark = std::get_if<remark::NotPredicted>(&judged.remarks.front());
    ASSERT_NE(remark, nullptr);
    EXPECT_EQ(remark->of_recordings, recordings);
  }
}

TEST(Thresholds, WhatIsMoreProbablyChanceIsNoAlarm) {
  EXPECT_EQ(verdict_of(0.49, false, false), Verdict::unexplained);
  EXPECT_EQ(verdict_of(0.51, false, false), Verdict::consistent);
  EXPECT_EQ(verdict_of(0.04, true, false), Verdict::named);
  EXPECT_EQ(verdict_of(0.06, true, false), Verdict::ambiguous);
  EXPECT_EQ(verdict_of(0.51, true, false), Verdict::consistent);
}

TEST(Thresholds, ACauseOrNoiseIsAmbiguousUnlessOneOfThemIsCredible) {
  EXPECT_EQ(verdict_of(0.04, true, true), Verdict::named);
  EXPECT_EQ(verdict_of(0.06, true, true), Verdict::ambiguous);
  EXPECT_EQ(verdict_of(0.94, true, true), Verdict::ambiguous);
  EXPECT_EQ(verdict_of(0.96, true, true), Verdict::consistent);
}

TEST(Thresholds, ACauseOrWrongPriorsIsAmbiguousUnlessTheseAreNotCredible) {
  EXPECT_EQ(verdict_of(0.0, true, false, 2.0, 0.04), Verdict::named);
  EXPECT_EQ(verdict_of(0.0, true, false, 2.0, 0.06), Verdict::ambiguous);
  EXPECT_EQ(verdict_of(0.0, true, false, 2.0, 0.94), Verdict::ambiguous);
  EXPECT_EQ(verdict_of(0.0, true, false, 2.0, 0.96), Verdict::consistent) << "but for the priors";
  EXPECT_EQ(verdict_of(0.6, true, false, 2.0, 0.0), Verdict::consistent);
  EXPECT_EQ(verdict_of(0.6, true, false, 2.0, 0.06), Verdict::consistent) << "no less nothing";
}

TEST(Thresholds, WhatIsMoreProbableOutsideTheLibraryIsSaidBesideItsCause) {
  const auto said = [](double outside, std::size_t causes) {
    Diagnosis d;
    d.verdict = Verdict::ambiguous;
    d.causes.resize(causes);
    for (search::Cause& c : d.causes) c.term = "magnetic_drift";
    d.probabilities.outside = outside;
    return report::sentence(d).find("no term describes") != std::string::npos;
  };
  EXPECT_FALSE(said(0.49, 1));
  EXPECT_TRUE(said(0.51, 1));
  EXPECT_FALSE(said(0.51, 0));
}

TEST(Thresholds, ASizeBeyondThreeSigmaOfItsPriorWidensIt) {
  const auto sigma_of = [](double prior_sigmas) {
    const ParamSpec& spec = TermLibrary::specs[param("M_y")];
    search::Cause cause;
    cause.term = "magnetic_drift";
    cause.parameters = {{"M_y", param("M_y"), prior_sigmas * spec.prior.sigma(), 0.1, "", false}};
    return patched_filter(test::base_filter(Coupling::eq5), {cause}).priors[param("M_y")].sigma() /
           spec.prior_si().sigma();
  };
  EXPECT_DOUBLE_EQ(sigma_of(2.9), 1.0);
  EXPECT_NEAR(sigma_of(3.1), 3.1, 1e-12);
}

}  // namespace
}  // namespace drift::diagnosis::thresholds_test
