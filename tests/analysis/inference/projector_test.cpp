// The restricted likelihood and the scores by dense algebra: with V the covariance of all rows,
// parameters included, everything is a quadratic form in V^-1.
#include "analysis/inference/projector.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numeric>

#include "analysis/inference/evidence.hpp"
#include "tests/support/dense_covariance.hpp"
#include "tests/support/random_problem.hpp"

namespace drift::inference::projector_test {
namespace {

constexpr int parameters = 7, candidates = 5;

const LinearProblem& problem() {
  static const LinearProblem p = test::random_problem(parameters, candidates);
  return p;
}

/// Marginal covariance of the rows.
MatX covariance(const LinearProblem& p, const NoiseModel& noise) {
  return test::DenseCovariance(p, noise).all() + p.theta * p.theta.transpose();
}

// V has eigenvalues between 0.6 (the smallest white noise) and some 1e4 (random walks of 20
// intervals): two ways of solving with it agree to 1e4 roundings times the number of rows, 120.
constexpr double precision = 1e-9;

void expect_near(const MatX& value, const MatX& expected) {
  ASSERT_EQ(value.rows(), expected.rows());
  ASSERT_EQ(value.cols(), expected.cols());
  EXPECT_LT((value - expected).cwiseAbs().maxCoeff(),
            precision * std::max(1.0, expected.cwiseAbs().maxCoeff()));
}

void expect_marginal(const LinearProblem& p, const NoiseModel& noise, const MatX& V) {
  const Marginal m = Projector(p, noise).marginal();
  const Eigen::LLT<MatX> llt(V);
  const MatX L = llt.matrixL();
  const double chi2 = p.r0.dot(llt.solve(p.r0));
  const double log_det = 2.0 * L.diagonal().array().log().sum();
  EXPECT_EQ(m.rows, p.rows());
  EXPECT_NEAR(m.chi2, chi2, precision * chi2);
  EXPECT_NEAR(m.log_det, log_det, precision * std::abs(log_det));
  EXPECT_NEAR(m.log_likelihood2(), -chi2 - log_det, precision * (chi2 + std::abs(log_det)));
}

TEST(Projector, RestrictedLikelihoodIsThatOfTheDenseCovariance) {
  for (const NoiseModel& noise : {NoiseModel{}, test::every_noise()})
    expect_marginal(problem(), noise, covariance(problem(), noise));
}

TEST(LinearProblem, CandidatesInTheMeanHaveUnitPriors) {
  const NoiseModel noise = test::every_noise();
  const LinearProblem with = problem().with_mean({3, 1});
  const MatX S = problem().extra(Eigen::all, std::vector<int>{3, 1});
  expect_marginal(with, noise, covariance(problem(), noise) + S * S.transpose());
  EXPECT_EQ(with.extra, problem().extra);  // numbers of candidates hold
  EXPECT_EQ(with.r0, problem().r0);
}

TEST(LinearProblem, BareHasTheLikelihoodAndNoCandidates) {
  const NoiseModel noise = test::every_noise();
  const LinearProblem bare = problem().bare();
  EXPECT_EQ(bare.extra.cols(), 0);
  EXPECT_EQ(bare.extra.rows(), problem().rows());
  expect_marginal(bare, noise, covariance(problem(), noise));
}

TEST(LinearProblem, WithoutIntervalsIsTheMarginalOfTheOtherRows) {
  const NoiseModel noise = test::every_noise();
  std::vector<bool> marked(problem().drives.size(), false);
  for (const std::size_t i : {0u, 6u, 7u, 19u}) marked[i] = true;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < problem().rows(); ++k)
    if (!marked[problem().tags[static_cast<std::size_t>(k)].interval]) kept.push_back(k);
  const LinearProblem rest = problem().without(marked);
  ASSERT_EQ(rest.rows(), static_cast<Eigen::Index>(kept.size()));
  expect_marginal(rest, noise, covariance(problem(), noise)(kept, kept));
  EXPECT_EQ(rest.extra, problem().extra(kept, Eigen::all));
}

TEST(Projector, ScoresAreQuadraticFormsInTheInverseCovariance) {
  const NoiseModel noise = test::every_noise();
  const Projector projector(problem(), noise);
  const MatX inverse = covariance(problem(), noise).inverse();
  const MatX& S = problem().extra;
  const Projected all = projector.candidates();
  expect_near(all.C, S.transpose() * inverse * S);
  expect_near(all.g, S.transpose() * inverse * problem().r0);
  const MatX noise_alone = test::DenseCovariance(problem(), noise).all();
  expect_near(all.raw, (S.transpose() * noise_alone.inverse() * S).diagonal());
  const std::vector<int> some{4, 0};
  const Projected part = projector.candidates(some);
  expect_near(part.C, all.C(some, some));
  expect_near(part.g, all.g(some));
  expect_near(part.raw, all.raw(some));
}

TEST(Projector, AScanOfLaterRowsIsThatOfColumnsThatAreZeroBefore) {
  const NoiseModel noise = test::every_noise();
  const Projector projector(problem(), noise);
  const MatX inverse = covariance(problem(), noise).inverse();
  constexpr Eigen::Index first = 33, count = 40;
  MatX whole = MatX::Zero(problem().rows(), 2);
  whole.bottomRows(problem().rows() - first) =
      problem().extra.bottomRows(problem().rows() - first).rightCols(2);
  const Projector::Scan scan = projector.scan(whole.bottomRows(problem().rows() - first), first);
  expect_near(scan.C, whole.transpose() * inverse * whole);
  expect_near(scan.cross, whole.transpose() * inverse * problem().extra);
  expect_near(scan.g, whole.transpose() * inverse * problem().r0);
  // Cut off before the end, a column still has the direction of a test, and an exact variance.
  const Projector::Scan cut = projector.scan(whole.middleRows(first, count), first);
  EXPECT_LE(cut.C(0, 0), cut.raw[0]);
}

TEST(Projector, ReplayPutsOtherDataInThePlaceOfTheResidual) {
  const NoiseModel noise = test::every_noise();
  const Projector projector(problem(), noise);
  MatX recordings(problem().rows(), 3);
  recordings << problem().r0, problem().extra.col(0), problem().theta.col(2);
  const Projector::Replay replay = projector.replay(recordings);
  for (Eigen::Index k = 0; k < 3; ++k) {
    LinearProblem other = problem();
    other.r0 = recordings.col(k);
    const Projector expected(other, noise);
    EXPECT_NEAR(replay.log_likelihood2[k], expected.marginal().log_likelihood2(),
                precision * std::abs(expected.marginal().log_likelihood2()));
    expect_near(replay.g.col(k), expected.candidates().g);
  }
}

TEST(Projector, TheFitIsThePosteriorOfTheParameters) {
  const NoiseModel noise = test::every_noise();
  const Projector projector(problem(), noise);
  const MatX& T = problem().theta;
  const MatX inverse = test::DenseCovariance(problem(), noise).all().inverse();
  const MatX P = (MatX::Identity(parameters, parameters) + T.transpose() * inverse * T).inverse();
  const Projector::Fit fit = projector.fit();
  expect_near(fit.covariance, P);
  expect_near(fit.x, P * T.transpose() * inverse * problem().r0);
  expect_near(projector.clean_residual(), projector.whitener().apply(problem().r0 - T * fit.x));
}

TEST(Evidence, RatioIsWhatTheCandidateGainsAtItsBest) {
  // Twice the log of the maximum over the amplitudes of likelihood times unit prior: that of the
  // column in the mean, its price (log det) taken off.
  const NoiseModel noise = test::every_noise();
  CandidateSet set;
  set.candidates.push_back({"term", "", "", {0, 1}, {{{1, 2}, {}}, {{0, 4}, {}}}});
  const Evidence e = evidence_under(problem(), set, noise, {3});
  const auto marginal = [&](const std::vector<int>& columns) {
    return Projector(problem().with_mean(columns), noise).marginal();
  };
  EXPECT_NEAR(e.log_likelihood2, marginal({3}).log_likelihood2(),
              1e-9 * static_cast<double>(problem().rows()));
  const double first = marginal({3}).chi2 - marginal({3, 1, 2}).chi2,
               second = marginal({3}).chi2 - marginal({3, 0, 4}).chi2;
  ASSERT_EQ(e.gains.size(), 1u);
  EXPECT_NEAR(e.gains[0].ratio, std::max(first, second), 1e-9 * marginal({3}).chi2);
  EXPECT_EQ(e.gains[0].variant, first > second ? 0u : 1u);
  EXPECT_EQ(e.gains[0].dof, 2);
}

}  // namespace
}  // namespace drift::inference::projector_test
