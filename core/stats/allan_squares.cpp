#include "core/stats/allan_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace drift::stats {
namespace {

/// The noises of a set whose bits are in `mask`.
AllanSet subset(const AllanSet& set, unsigned mask) {
  AllanSet out{};
  for (int a = 0; a < allan_noises; ++a) out[a] = set[a] && (mask >> a & 1U) != 0;
  return out;
}

bool within(const AllanSet& set, unsigned mask) {
  for (int a = 0; a < allan_noises; ++a)
    if ((mask >> a & 1U) != 0 && !set[a]) return false;
  return true;
}

/// Every subset is tried: with five noises that is the surest way to the best one.
AllanEstimate best_estimate(const AllanProblem& problem, const AllanSet& set,
                            const Eigen::MatrixXd& covariance) {
  AllanEstimate best;
  best.chi_square = std::numeric_limits<double>::infinity();
  for (unsigned mask = 1; mask < 1U << allan_noises; ++mask) {
    const AllanSet part = subset(set, mask);
    if (!within(set, mask) || !has_noise(part) || std::popcount(mask) > problem.variances.size())
      continue;
    AllanEstimate one = free_estimate(problem, part, covariance);
    if ((one.squares.array() >= 0.0).all() && one.chi_square < best.chi_square)
      best = std::move(one);
  }
  return best;
}

/// To begin with: every variance as uncertain as a third of itself, at long times more.
Eigen::MatrixXd first_covariance(const AllanProblem& problem) {
  const Eigen::Index n = problem.variances.size();
  Eigen::MatrixXd first = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double sigma = problem.variances[i] * std::exp2(0.5 * static_cast<double>(i));
    first(i, i) = std::max(sigma * sigma, std::numeric_limits<double>::min());
  }
  return first;
}

}  // namespace

AllanEstimate free_estimate(const AllanProblem& problem, const AllanSet& set,
                            const Eigen::MatrixXd& covariance) {
  std::vector<int> in;
  for (int a = 0; a < allan_noises; ++a)
    if (set[a]) in.push_back(a);
  const Eigen::Index n = problem.variances.size(), k = static_cast<Eigen::Index>(in.size());
  // In units of the standard deviation of each variance: they span ten decades.
  const Eigen::ArrayXd scale = covariance.diagonal().array().sqrt().inverse();
  Eigen::MatrixXd correlation =
      scale.matrix().asDiagonal() * covariance * scale.matrix().asDiagonal();
  correlation.diagonal().array() += 1e-9;
  const Eigen::LLT<Eigen::MatrixXd> root(correlation);
  Eigen::MatrixXd slopes(n, k);
  for (Eigen::Index c = 0; c < k; ++c) slopes.col(c) = scale * problem.slopes.col(in[c]).array();
  const Eigen::VectorXd size = slopes.colwise().norm();
  slopes = slopes * size.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd whitened = root.matrixL().solve(slopes);
  const Eigen::VectorXd target = root.matrixL().solve((scale * problem.variances.array()).matrix());
  const Eigen::LDLT<Eigen::MatrixXd> normal(whitened.transpose() * whitened);
  // squares = (S' C^-1 S)^-1 S' C^-1 v, in the units of v and of the slopes.
  const Eigen::MatrixXd weights = size.cwiseInverse().asDiagonal() *
                                  normal.solve(root.solve(slopes).transpose()) *
                                  scale.matrix().asDiagonal();
  const Eigen::MatrixXd spread = size.cwiseInverse().asDiagonal() *
                                 normal.solve(Eigen::MatrixXd::Identity(k, k)) *
                                 size.cwiseInverse().asDiagonal();
  AllanEstimate out;
  out.weights = Eigen::MatrixXd::Zero(allan_noises, n);
  const Eigen::VectorXd squares = weights * problem.variances;
  for (Eigen::Index c = 0; c < k; ++c) {
    out.squares[in[c]] = squares[c];
    out.weights.row(in[c]) = weights.row(c);
    for (Eigen::Index d = 0; d < k; ++d) out.covariance(in[c], in[d]) = spread(c, d);
  }
  out.chi_square = (target - whitened * size.asDiagonal() * squares).squaredNorm();
  out.surprise = out.chi_square +
                 2.0 * Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum() -
                 2.0 * scale.log().sum();
  return out;
}

AllanEstimate estimate_squares(const AllanProblem& problem, const AllanSet& set) {
  constexpr int most = 50;
  constexpr double enough = 1e-6;
  AllanEstimate now = best_estimate(problem, set, first_covariance(problem));
  for (int i = 0; i < most; ++i) {
    const AllanEstimate next = best_estimate(problem, set, problem.covariance.of(now.squares));
    const Eigen::VectorXd before = problem.slopes * now.squares,
                          after = problem.slopes * next.squares;
    now = next;
    if (((after - before).array().abs() <= enough * after.array()).all()) break;
  }
  return now;
}

}  // namespace drift::stats
