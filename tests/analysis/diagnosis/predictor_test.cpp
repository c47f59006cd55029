#include "analysis/diagnosis/held_out/predictor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>

#include "analysis/diagnosis/held_out/held_out_part.hpp"
#include "tests/support/dense_covariance.hpp"
#include "tests/support/random_problem.hpp"

namespace drift::diagnosis::predictor_test {
namespace {

TEST(Predictor, IsTheConditionalDensityOfTheDenseCovariance) {
  const inference::LinearProblem p = test::random_problem(6, 3);
  const inference::NoiseModel noise = test::every_noise();
  const MatX V = test::DenseCovariance(p, noise).all() + p.theta * p.theta.transpose();
  for (const HeldOutPart& part : positions_of(p)) {
    std::vector<Eigen::Index> held, rest;
    for (Eigen::Index k = 0; k < p.rows(); ++k)
      (part.intervals[p.tags[static_cast<std::size_t>(k)].interval] ? held : rest).push_back(k);
    // Mean and covariance of what is held out, given the rest.
    const MatX gain = V(rest, rest).llt().solve(V(rest, held)).transpose();
    const VecX off = p.r0(held) - gain * p.r0(rest);
    const MatX S = V(held, held) - gain * V(rest, held);
    const Eigen::LLT<MatX> llt(S);
    const MatX L = llt.matrixL();
    const double chi2 = off.dot(llt.solve(off));
    const double log_density =
        -0.5 * chi2 - L.diagonal().array().log().sum() -
        0.5 * static_cast<double>(held.size()) * std::log(2.0 * std::numbers::pi);
    const Prediction found = Predictor(p, noise).predict(part.intervals);
    EXPECT_EQ(found.rows, held.size());
    // Differences of sums over 120 rows, condition number 1e4 (projector_test.cpp).
    EXPECT_NEAR(found.chi2, chi2, 1e-8 * chi2);
    EXPECT_NEAR(found.log_score, log_density, 1e-8 * std::abs(log_density));
  }
}

TEST(HeldOutPart, PositionsAndRecordingsCoverEachIntervalOnce) {
  const inference::LinearProblem p = test::random_problem(2, 0);
  const std::vector<HeldOutPart> positions = positions_of(p);
  ASSERT_EQ(positions.size(), 4u);
  EXPECT_EQ(positions[2].number, 3);
  const std::vector<HeldOutPart> recordings = recordings_of(p, {10, 20});
  ASSERT_EQ(recordings.size(), 2u);
  EXPECT_EQ(recordings[1].of, Fold::Of::recording);
  EXPECT_EQ(recordings[1].positions, (std::vector<int>{3, 4}));
  for (const auto* parts : {&positions, &recordings})
    for (std::size_t i = 0; i < p.drives.size(); ++i) {
      std::size_t times = 0;
      for (const HeldOutPart& part : *parts) times += part.intervals[i];
      EXPECT_EQ(times, 1u) << i;
    }
  EXPECT_TRUE(recordings_of(p, {20}).empty());
}

}  // namespace
}  // namespace drift::diagnosis::predictor_test
