#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/blind/rivals/recovered_rates.hpp"
#include "core/base/decompose.hpp"

namespace drift::blind {
namespace {

/// Least squares on some columns with a little ridge, as SINDy's optimiser has it (0.05).
VecX coefficients(const RateRegression& r, const std::vector<int>& columns) {
  MatX G = r.gram(columns, columns);
  G.diagonal().array() += 0.05;
  return Cholesky(G).solve(VecX(r.product(columns)));
}

/// Columns that survive: least squares, small coefficients out, again.
std::vector<int> survivors(const RateRegression& r, std::vector<int> columns, VecX x,
                           double threshold) {
  constexpr int rounds = 10;
  for (int round = 0; round < rounds && !columns.empty(); ++round) {
    std::vector<int> kept;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (std::abs(x[static_cast<Eigen::Index>(k)]) >= threshold) kept.push_back(columns[k]);
    if (kept.size() == columns.size()) break;
    columns = std::move(kept);
    if (!columns.empty()) x = coefficients(r, columns);
  }
  return columns;
}

}  // namespace

RivalAnswer thresholded_least_squares(const RivalTest& test, double) {
  const RateRegression r = rate_regression(test);
  if (r.count == 0.0 || r.candidate.empty()) return {};
  std::vector<int> all(r.candidate.size());
  std::iota(all.begin(), all.end(), 0);
  const VecX x = coefficients(r, all);
  std::vector<int> best;
  double least = r.bic({});
  for (double threshold = r.product.cwiseAbs().maxCoeff(); threshold > 0.5; threshold *= 0.75) {
    const std::vector<int> columns = survivors(r, all, x, threshold);
    if (static_cast<double>(columns.size()) > 0.5 * r.count) break;
    if (const double bic = r.bic(columns); bic < least) {
      least = bic;
      best = columns;
    }
  }
  return answer_of(r, best);
}

}  // namespace drift::blind
