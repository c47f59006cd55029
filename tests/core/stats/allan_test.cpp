#include "core/stats/allan.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "core/stats/allan_covariance.hpp"
#include "core/stats/lag_sum.hpp"

namespace drift::stats::allan_test {
namespace {

TEST(Allan, PublishedValuesComeOut) {
  // Nine frequencies of NBS Monograph 140, in Riley, NIST SP 1065, table 30: printed to 7 digits.
  const Stretch nbs{892, 809, 823, 798, 671, 644, 883, 903, 677};
  const std::size_t counts[] = {1, 2};
  const auto v = allan_variances({&nbs, 1}, counts);
  EXPECT_NEAR(std::sqrt(v[0]), 91.22945, 5e-6);
  EXPECT_NEAR(std::sqrt(v[1]), 85.95287, 5e-6);
}

TEST(Allan, ARampIsItsClosedFormAndNothingIsTakenFromOneStretchToTheNext) {
  std::vector<Stretch> two(2);
  for (int k = 0; k < 100; ++k) two[0].push_back(0.5 * k);
  for (int k = 0; k < 40; ++k) two[1].push_back(1e6 + 0.5 * k);
  const auto counts = averaging_counts(100);
  EXPECT_EQ(counts.front(), 1u);
  EXPECT_LE(3 * counts.back(), 100u);
  const auto v = allan_variances(two, counts);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double m = static_cast<double>(counts[i]);
    EXPECT_NEAR(v[i], 0.25 * allan_slopes(m)[4], 1e-9 * v[i]) << m;
  }
  EXPECT_TRUE(std::isnan(allan_variances(two, std::vector<std::size_t>{51})[0]));
}

TEST(Allan, StretchesCountByThePlacesTheyHave) {
  // 1, -1, 1 differs by 2 twice, 0, 4 by 4 once: (2^2 + 2^2 + 4^2) / 3 / 2.
  const std::vector<Stretch> two{{1.0, -1.0, 1.0}, {0.0, 4.0}};
  EXPECT_NEAR(allan_variances(two, std::vector<std::size_t>{1})[0], 4.0, 1e-12);
}

TEST(Allan, ASumOverLagsIsTheSumOfAllOfThem) {
  // Powers and a logarithm, as the covariances are; the error of the short cut is f'/24 at its
  // ends.
  const double bends[] = {-20000.0, -3000.0, 0.0, 7.0, 5000.0, 90000.0};
  const auto f = [](double lag) {
    return std::pow(10.0 + std::abs(lag), -1.7) * std::log(2.0 + std::abs(lag));
  };
  double all = 0.0, few = 0.0;
  for (double lag = bends[0]; lag <= bends[5]; lag += 1.0) all += f(lag);
  const auto nodes = lag_nodes(bends);
  for (const auto& n : nodes) few += n.weight * f(n.lag);
  EXPECT_NEAR(few, all, 1e-4 * all);
  EXPECT_LT(nodes.size(), 1000u);
}

/// Covariance of Allan variances by matrices: 2 tr(A1 S A2 S) and, of a ramp, 4 r' A1 S A2 r, where
/// S follows from the generalised covariance g of the integrated rate.
class Matrices {
 public:
  Matrices(std::vector<std::size_t> lengths, auto&& g) : lengths_(std::move(lengths)) {
    Eigen::Index n = 0;
    for (const std::size_t l : lengths_) n += static_cast<Eigen::Index>(l);
    std::vector<double> table;  // of g, which may be slow
    for (Eigen::Index h = 0; h <= n; ++h) table.push_back(g(static_cast<double>(h)));
    S_ = Eigen::MatrixXd::Zero(n, n);
    ramp_ = Eigen::VectorXd::Zero(n);
    Eigen::Index first = 0;
    for (const std::size_t l : lengths_) {
      for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(l); ++i) {
        ramp_[first + i] = static_cast<double>(i);
        for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(l); ++j) {
          const auto h = std::abs(i - j);
          S_(first + i, first + j) = 2.0 * table[h] - table[h + 1] - table[std::abs(h - 1)];
        }
      }
      first += static_cast<Eigen::Index>(l);
    }
  }

  /// The form of one variance, and its product with S.
  struct Form {
    Eigen::MatrixXd A, AS;
  };
  Form of(std::size_t m) const {
    const Eigen::MatrixXd A = form(m);
    return {A, A * S_};
  }
  double covariance(const Form& one, const Form& two, double ramp_square) const {
    return 2.0 * one.AS.cwiseProduct(two.AS.transpose()).sum() +
           4.0 * ramp_square * ramp_.dot(one.AS * (two.A * ramp_));
  }

 private:
  Eigen::MatrixXd form(std::size_t m) const {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(S_.rows(), S_.rows());
    const auto step = static_cast<Eigen::Index>(m);
    double count = 0.0;
    Eigen::Index first = 0;
    for (const std::size_t l : lengths_) {
      for (std::size_t k = 0; k < places(l, m); ++k) {
        Eigen::VectorXd d = Eigen::VectorXd::Ones(2 * step);
        d.head(step).setConstant(-1.0);
        const Eigen::Index at = first + static_cast<Eigen::Index>(k);
        A.block(at, at, 2 * step, 2 * step) += d * d.transpose();
        count += 1.0;
      }
      first += static_cast<Eigen::Index>(l);
    }
    return A / (2.0 * static_cast<double>(m * m) * count);
  }

  std::vector<std::size_t> lengths_;
  Eigen::MatrixXd S_;
  Eigen::VectorXd ramp_;
};

void expect_covariance(const AllanSquares& squares, auto&& g, double tolerance) {
  const std::vector<std::size_t> lengths{90, 40, 21}, counts{1, 2, 5, 13, 30};
  const Matrices matrices(lengths, g);
  const Eigen::MatrixXd got = AllanCovariance(lengths, counts).of(squares);
  std::vector<Matrices::Form> forms;
  for (const std::size_t m : counts) forms.push_back(matrices.of(m));
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (std::size_t j = 0; j < counts.size(); ++j)
      EXPECT_NEAR(got(i, j), matrices.covariance(forms[i], forms[j], squares[4]),
                  tolerance * std::sqrt(got(i, i) * got(j, j)))
          << counts[i] << " " << counts[j];
}

TEST(Allan, CovarianceOfItsVariancesIsThatOfTheQuadraticForms) {
  // Rounding, and f'/24 where lags are taken together: a few times 1e-4 at most.
  const double Q = 1.3, N = 0.7, K = 0.05;
  expect_covariance(
      {Q * Q, N * N, 0.0, K * K, 1e-4},
      [&](double t) {
        t = std::abs(t);
        return (t == 0.0 ? Q * Q : 0.0) - 0.5 * N * N * t + K * K * t * t * t / 12.0;
      },
      1e-3);
}

TEST(Allan, CovarianceOfFlickerIsThatOfManyTimeConstants) {
  // Flicker as Markov processes of all rates a between 1e-7 and 1e5 per sample, B^2 / pi of
  // variance for each unit of ln a (their spectra 2a / (a^2 + w^2) add up to pi / w): what the ends
  // leave out is below 1e-4 of it.
  // Differences do not see the parabola t^2 / 2 that slow ones have: it is left out.
  const auto markov = [](double t, double a) {
    const double x = a * t, parabola = a < 1.0 ? 0.5 * x * x : 0.0;
    const double whole = x + std::expm1(-x) - parabola;
    const double series = x * x * x * (x / 24.0 - 1.0 / 6.0) + 0.5 * x * x - parabola;
    return -(x < 1e-3 ? series : whole) / (a * a);
  };
  expect_covariance(
      {0.0, 0.0, 1.0, 0.0, 0.0},
      [&](double t) {
        constexpr double step = 0.02;
        double sum = 0.0;
        for (double log_a = std::log(1e-7); log_a < std::log(1e5); log_a += step)
          sum += markov(std::abs(t), std::exp(log_a)) * step / std::numbers::pi;
        return sum;
      },
      3e-3);
}

}  // namespace
}  // namespace drift::stats::allan_test
