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

/// Rows of a problem, in the order of time; some perhaps more than once.
LinearProblem rows_of(const LinearProblem& p, const std::vector<Eigen::Index>& rows) {
  LinearProblem some = p;
  some.tags.clear();
  for (const Eigen::Index k : rows) some.tags.push_back(p.tags[static_cast<std::size_t>(k)]);
  some.psi = p.psi(rows, Eigen::all);
  some.theta = p.theta(rows, Eigen::all);
  some.extra = p.extra(rows, Eigen::all);
  some.r0 = p.r0(rows);
  some.weight = p.weight(rows);
  return some;
}

/// None of an instrument, and as many as are summed up at once: 128, and twice as many.
TEST(MarginalOf, AnyNumberOfRowsOfAnInstrument) {
  const LinearProblem p = test::random_problem(6, 5);
  for (const bool accelerometer : {true, false})
    for (const std::size_t count : {60u, 128u, 256u}) {
      std::vector<Eigen::Index> rows;
      for (std::size_t k = 0; k < count; ++k)  // the k-th of the 60 that there are
        rows.push_back(static_cast<Eigen::Index>(6 * (k * 60 / count / 3) + (k * 60 / count) % 3 +
                                                 (accelerometer ? 0 : 3)));
      const LinearProblem some = rows_of(p, rows);
      for (const RowTag& t : some.tags) ASSERT_EQ(t.accelerometer(), accelerometer);
      expect_same(marginal_of(some, white()), Projector(some, white()).marginal());
    }
}

}  // namespace
}  // namespace drift::inference::sums_by_cell_test
