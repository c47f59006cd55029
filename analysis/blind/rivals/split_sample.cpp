#include <cmath>

#include "analysis/blind/rivals/rival.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::blind {
namespace {

/// The test with every other position only; half: 0 or 1.
inference::Projector half_of(const RivalTest& test, int half) {
  const inference::LinearProblem& whole = test.examined.problem;
  std::vector<bool> left_out(whole.drives.size(), false);
  for (const inference::RowTag& t : whole.tags)
    if (t.position % 2 != half) left_out[t.interval] = true;
  return {whole.without(left_out), test.examined.noise.model};
}

}  // namespace

RivalAnswer split_sample(const RivalTest& test, double alpha) {
  std::vector<int> columns;
  for (const RivalTest::Column& c : test.columns) columns.push_back(c.column);
  if (columns.empty()) return {};
  const inference::Projected first = half_of(test, 0).candidates(columns);
  double largest = 0.0;
  Eigen::Index best = 0;
  for (Eigen::Index k = 0; k < first.g.size(); ++k) {
    if (first.C(k, k) <= inference::VisibleLimits::information) continue;
    const double T = first.g[k] * first.g[k] / first.C(k, k);
    if (!(T > largest)) continue;
    largest = T;
    best = k;
  }
  const RivalTest::Column& chosen = test.columns[static_cast<std::size_t>(best)];
  const inference::Projector other = half_of(test, 1);
  const inference::Projected second = other.candidates({chosen.column});
  RivalAnswer out;
  if (largest == 0.0 || second.C(0, 0) <= inference::VisibleLimits::information) return out;
  // F of one degree against the residual variance of the half, which has so many degrees that its
  // tail is that of chi-square.
  const double variance =
      other.marginal().chi2 / static_cast<double>(std::max<Eigen::Index>(1, other.marginal().rows));
  const double F = second.g[0] * second.g[0] / second.C(0, 0) / variance;
  out.alarm = stats::log_tail(F, 1) < std::log(alpha);
  if (out.alarm) out.named = {chosen.candidate};
  return out;
}

}  // namespace drift::blind
