#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/blind/rivals/rival.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::blind {
namespace {

/// Whether Benjamini and Hochberg (1995) reject the least of these p-values (logs) at rate q: some
/// p-value is no more than q times its rank over their number.
bool any_rejected(std::vector<double> log_p, double q) {
  std::ranges::sort(log_p);
  for (std::size_t k = 0; k < log_p.size(); ++k)
    if (log_p[k] <= std::log(q * static_cast<double>(k + 1) / static_cast<double>(log_p.size())))
      return true;
  return false;
}

}  // namespace

RivalAnswer forward_selection(const RivalTest& test, double alpha) {
  constexpr std::size_t most = 6;
  MatX C = test.examined.projected.C;
  VecX g = test.examined.projected.g;
  const VecX before = C.diagonal();
  RivalAnswer out;
  std::set<std::size_t> named;
  while (named.size() < most) {
    std::vector<double> log_p;
    double largest = 0.0;
    RivalTest::Column best;
    for (const RivalTest::Column& c : test.columns) {
      // What the chosen ones leave of a signature must be more than rounding.
      if (C(c.column, c.column) <= 1e-6 * before[c.column] || named.contains(c.candidate)) continue;
      const double T = g[c.column] * g[c.column] / C(c.column, c.column);
      log_p.push_back(stats::log_tail(T, 1));
      if (T > largest) {
        largest = T;
        best = c;
      }
    }
    if (largest == 0.0 || !any_rejected(std::move(log_p), alpha)) break;
    named.insert(best.candidate);
    const VecX column = C.col(best.column);
    const double pivot = column[best.column], gradient = g[best.column];
    C.noalias() -= column * (column.transpose() / pivot);
    g -= column * (gradient / pivot);
  }
  out.named.assign(named.begin(), named.end());
  out.alarm = !named.empty();
  return out;
}

}  // namespace drift::blind
