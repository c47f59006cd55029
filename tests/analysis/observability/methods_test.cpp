// The other methods, and the ranking beside a Monte Carlo study.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

#include "analysis/observability/against_monte_carlo.hpp"
#include "analysis/observability/other_methods.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::methods_test {
namespace {

using namespace drift::test;

VecX vec(std::initializer_list<double> values) {
  VecX v(static_cast<Eigen::Index>(values.size()));
  std::ranges::copy(values, v.begin());
  return v;
}

TEST(Methods, RanksShareTiesAndSpearmanIsOneForTheSameOrder) {
  EXPECT_EQ(observability::ranks_of(vec({5.0, 9.0, 5.0, 1.0})), vec({2.5, 1.0, 2.5, 4.0}));
  EXPECT_DOUBLE_EQ(observability::spearman(vec({1.0, 2.0, 3.0, 9.0}), vec({-3.0, 0.0, 1e6, 1e7})),
                   1.0);
  EXPECT_DOUBLE_EQ(observability::spearman(vec({1.0, 2.0, 3.0}), vec({3.0, 2.0, 1.0})), -1.0);
  // Textbook: 1 - 6 sum d^2 / (n (n^2 - 1)) without ties; d = 1, 1, 1, 1.
  EXPECT_DOUBLE_EQ(observability::spearman(vec({1.0, 2.0, 3.0, 4.0}), vec({2.0, 1.0, 4.0, 3.0})),
                   1.0 - 6.0 * 4.0 / (4.0 * 15.0));
  EXPECT_TRUE(std::isnan(observability::spearman(vec({1.0}), vec({1.0}))));
}

TEST(Methods, SvdDegreeOfUncoupledStatesIsTheirSingularValue) {
  observability::PwcsRank pwcs;
  pwcs.V = MatX::Identity(6, 6);
  pwcs.singular_values = vec({10.0, 8.0, 5.0, 2.0, 0.5, 0.0});
  pwcs.rank = 5;
  EXPECT_EQ(observability::svd_degrees(pwcs), vec({0.2, 0.05, 0.0}));
}

observability::Ranking ranking_of(std::initializer_list<double> information) {
  observability::Ranking r;
  const auto n = static_cast<Eigen::Index>(information.size());
  r.covariance = MatX::Zero(n, n);
  Eigen::Index k = 0;
  for (const double i : information) {
    const double P = 1.0 / (1.0 + i);
    r.covariance(k, k) = P;
    r.layout.params.push_back(static_cast<std::size_t>(k));
    r.parameters.push_back({static_cast<std::size_t>(k), 2.0, 2.0 * std::sqrt(P),
                            2.0 * std::sqrt(P), static_cast<std::size_t>(k), 0.0});
    r.order.push_back(static_cast<std::size_t>(k));
    r.spectrum.push_back({i, VecX::Unit(n, k), {static_cast<std::size_t>(k)}});
    ++k;
  }
  r.layout.mean = VecX::Zero(n);
  r.layout.sigma = VecX::Constant(n, 2.0);
  return r;
}

TEST(Methods, HamBrownEigenvaluesSumToTheNumberOfStates) {
  const observability::Ranking r = ranking_of({99.0, 3.0, 0.0});
  const VecX score = observability::ham_brown_score(r);  // P = 0.01, 0.25, 1: their sum is 1.26
  EXPECT_NEAR(score.sum(), -3.0, 1e-12);
  EXPECT_NEAR(score[0], -0.01 * 3.0 / 1.26, 1e-12);
  EXPECT_NEAR(score[2], -3.0 / 1.26, 1e-12);
}

TEST(Methods, WhereRankingsDisagreeIsSaidWithTheReason) {
  const TestPlan plan =
      preset_plan("twentyfour", PlanDefaults{3600.0, 300.0, CommandLaw::level, {}}).value();
  const observability::RankedModel model =
      observability::ranked_model(base_spec(Coupling::eq5), nullptr, harbin, Readout{});
  const observability::LinearisedPlan linear = observability::linearise(plan, model);
  const observability::Ranking r = observability::rank_parameters(linear);
  const auto pwcs = observability::pwcs_rank(plan, harbin, model.spec, model.readout);
  const auto course = observability::information_course(linear);
  const auto methods = observability::compare_methods({r, pwcs, linear, course, plan});
  for (const observability::MethodRanking& m : methods) EXPECT_EQ(m.score.size(), 60) << m.key;
  ASSERT_GE(methods.size(), 3u);
  for (const observability::MethodRanking& m : std::span(methods).first(3)) {
    EXPECT_GT(m.spearman, 0.4) << m.key;
    EXPECT_LT(m.spearman, 1.0) << m.key;
    // What a conditional sigma cannot know: D_F is one sum with the trace of the g^2 terms.
    ASSERT_FALSE(m.disagreements.empty()) << m.key;
    EXPECT_EQ(TermLibrary::specs[r.layout.params[m.disagreements.front().state]].group, Name("D_F"))
        << m.key;
    EXPECT_LT(m.disagreements.front().rank_here, m.disagreements.front().rank_learning);
  }
  EXPECT_NE(methods[0].disagreements.front().reason.find("confused with D_"), std::string::npos);
}

TEST(AgainstMonteCarlo, VerdictsSayWhatTheErrorMeans) {
  // Learning ratios 0.1, 0.1, 0.1 and 1, prior 2.
  const observability::Ranking r = ranking_of({99.0, 99.0, 99.0, 0.0});
  const std::vector<observability::MonteCarloError> errors{{0, 0.21, 0.19, 0.23, 0.2},
                                                           {1, 0.6, 0.5, 0.7, 0.2},
                                                           {2, 0.1, 0.08, 0.12, 0.2},
                                                           {3, 2.8, 2.6, 3.0, 2.0}};
  const auto verdicts = [&](observability::TruthIs truth) {
    std::vector<observability::ErrorVerdict> all;
    for (const auto& c : observability::compare_with_monte_carlo(r, errors, truth).parameters)
      all.push_back(c.verdict);
    return all;
  };
  using enum observability::ErrorVerdict;
  EXPECT_EQ(verdicts(observability::TruthIs::the_model),
            (std::vector{agree, nonlinear, nonlinear, prior_dominated}));
  EXPECT_EQ(verdicts(observability::TruthIs::another_model),
            (std::vector{agree, wrong_model, nonlinear, prior_dominated}));
  const auto c =
      observability::compare_with_monte_carlo(r, errors, observability::TruthIs::another_model);
  EXPECT_NEAR(c.parameters[1].rmse_ratio, 0.3, 1e-15);
  EXPECT_NEAR(c.parameters[1].learning_ratio, 0.1, 1e-15);
  EXPECT_EQ(c.count(agree), 1u);
  EXPECT_TRUE(c.parameters[0].reason.empty());
  EXPECT_NE(c.parameters[1].reason.find("3 times"), std::string::npos) << c.parameters[1].reason;
  // An error three times the promise of which the filter knows is no sign of another model.
  const std::vector<observability::MonteCarloError> known{{1, 0.6, 0.5, 0.7, 0.6}};
  EXPECT_EQ(observability::compare_with_monte_carlo(r, known, observability::TruthIs::another_model)
                .parameters.front()
                .verdict,
            nonlinear);
}

TEST(AgainstMonteCarlo, ProcessNoiseIsNotTakenForNonlinearity) {
  const observability::Ranking r = ranking_of({3.0, 3.0});
  const std::vector<observability::MonteCarloError> errors{{0, 3.0, 2.5, 3.5, 3.0},
                                                           {1, 3.0, 2.5, 3.5, 0.5}};
  const auto c = observability::compare_with_monte_carlo(
      r, errors, observability::TruthIs::the_model, observability::ProcessNoiseIs::there);
  EXPECT_EQ(c.count(observability::ErrorVerdict::nonlinear), 0u);
  EXPECT_GT(c.count(observability::ErrorVerdict::process_noise), 0u);
  const auto wrong = observability::compare_with_monte_carlo(
      r, errors, observability::TruthIs::another_model, observability::ProcessNoiseIs::there);
  EXPECT_EQ(wrong.parameters[1].verdict, observability::ErrorVerdict::wrong_model);
}

TEST(AgainstMonteCarlo, AnErrorBeyondWhatThePriorCanExplainIsNotDominatedByIt) {
  const auto c = observability::compare_with_monte_carlo(
      ranking_of({0.0}), std::vector<observability::MonteCarloError>{{0, 20.0, 18.0, 22.0, 2.0}},
      observability::TruthIs::another_model);
  EXPECT_EQ(c.parameters.front().verdict, observability::ErrorVerdict::wrong_model);
}

TEST(AgainstMonteCarlo, WhatIsMissingOnEitherSideIsLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<observability::MonteCarloError> errors{
      {0, nan, nan, nan}, {1, 1.0, nan, nan}, {40, 1.0, 0.9, 1.1}};
  const auto c = observability::compare_with_monte_carlo(ranking_of({3.0, 3.0}), errors,
                                                         observability::TruthIs::the_model);
  ASSERT_EQ(c.parameters.size(), 1u);
  EXPECT_EQ(c.parameters.front().param, 1u);
  EXPECT_EQ(c.parameters.front().verdict, observability::ErrorVerdict::undecided)
      << "one run has no interval";
}

}  // namespace
}  // namespace drift::methods_test
