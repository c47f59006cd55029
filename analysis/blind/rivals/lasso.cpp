#include <cmath>

#include "analysis/blind/rivals/recovered_rates.hpp"

namespace drift::blind {
namespace {

/// Coordinate descent (Friedman, Hastie and Tibshirani 2010) on columns of unit norm, from x on.
VecX descend(const RateRegression& r, VecX x, double penalty) {
  constexpr int rounds = 200;
  VecX gradient = r.product - r.gram * x;
  for (int round = 0; round < rounds; ++round) {
    double moved = 0.0;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const double free = gradient[k] + x[k];
      const double to = std::copysign(std::max(0.0, std::abs(free) - penalty), free);
      if (to == x[k]) continue;
      gradient -= (to - x[k]) * r.gram.col(k);
      moved = std::max(moved, std::abs(to - x[k]));
      x[k] = to;
    }
    if (moved < 1e-3 * penalty) break;
  }
  return x;
}

}  // namespace

RivalAnswer lasso(const RivalTest& test, double) {
  const RateRegression r = rate_regression(test);
  if (r.count == 0.0 || r.candidate.empty()) return {};
  VecX x = VecX::Zero(r.product.size());
  std::vector<int> best;
  double least = r.square;
  const double largest = r.product.cwiseAbs().maxCoeff();
  for (double penalty = 0.9 * largest; penalty > 0.01 * largest; penalty *= 0.85) {
    x = descend(r, x, penalty);
    std::vector<int> columns;
    for (Eigen::Index k = 0; k < x.size(); ++k)
      if (x[k] != 0.0) columns.push_back(static_cast<int>(k));
    if (static_cast<double>(columns.size()) > 0.5 * r.count) break;
    const double left = r.square - 2.0 * x.dot(r.product) + x.dot(r.gram * x);
    const double bic = left + std::log(r.count) * static_cast<double>(columns.size());
    if (bic >= least) continue;
    least = bic;
    best = std::move(columns);
  }
  return answer_of(r, best);
}

}  // namespace drift::blind
