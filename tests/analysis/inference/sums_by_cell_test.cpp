#include "analysis/inference/sums_by_cell.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_problem.hpp"

namespace drift::inference::sums_by_cell_test {
namespace {

// Two ways to the same sums over 120 rows of white noise, condition about 1e3 (projector_test.cpp).
constexpr double precision = 1e-10;

void expect_near(const MatX& value, const MatX& expected) {
  ASSERT_EQ(value.rows(), expected.rows());
  ASSERT_EQ(value.cols(), expected.cols());
  EXPECT_LT((value - expected).cwiseAbs().maxCoeff(),
            precision * std::max(1.0, expected.cwiseAbs().maxCoeff()));
}

void expect_same(const Marginal& a, const Marginal& b) {
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_NEAR(a.chi2, b.chi2, precision * b.chi2);
  EXPECT_NEAR(a.log_det, b.log_det, precision * std::abs(b.log_det));
}

NoiseModel white() {
  NoiseModel noise;
  noise.acc_factor = 1.3;
  noise.gimbal_factor = 0.8;
  return noise;
}

/// All rows, each position left out, two positions of one chain, and of both.
std::vector<std::vector<bool>> parts_of(const LinearProblem& p) {
  std::vector<std::vector<bool>> parts(1, std::vector<bool>(p.drives.size(), false));
  for (const std::vector<int>& positions : {std::vector{0}, {1}, {2}, {3}, {0, 1}, {1, 2}}) {
    parts.push_back(parts.front());
    for (const RowTag& t : p.tags)
      for (const int position : positions)
        if (t.position == position) parts.back()[t.interval] = true;
  }
  return parts;
}

TEST(SumsByCell, SayWhatAProjectorOfTheOtherRowsSays) {
  const LinearProblem p = test::random_problem(6, 5);
  const SumsByCell sums(p, white());
  for (const std::vector<bool>& part : parts_of(p)) {
    const Projector rest(p.without(part), white());
    expect_same(sums.marginal(part), rest.marginal());
    const Projected a = sums.candidates(part), b = rest.candidates();
    expect_near(a.C, b.C);
    expect_near(a.g, b.g);
    expect_near(a.raw, b.raw);
    const std::vector<int> with = {3, 0};
    expect_same(sums.marginal(part, with),
                Projector(p.without(part).with_mean(with), white()).marginal());
  }
}

TEST(SumsByCell, AreForWhiteNoiseAlone) {
  EXPECT_TRUE(SumsByCell::can(white()));
  EXPECT_FALSE(SumsByCell::can(test::every_noise()));
}

TEST(MarginalOf, IsThatOfAProjectorWithoutItsColumns) {
  const LinearProblem p = test::random_problem(6, 5);
  for (const NoiseModel& noise : {white(), test::every_noise()}) {
    expect_same(marginal_of(p, noise), Projector(p, noise).marginal());
    expect_same(marginal_of(p, noise, {4, 1}), Projector(p.with_mean({4, 1}), noise).marginal());
  }
}

}  // namespace
}  // namespace drift::inference::sums_by_cell_test
