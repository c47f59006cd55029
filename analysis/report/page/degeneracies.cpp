#include "analysis/report/page/degeneracies.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/report/page/known_degeneracies.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {
namespace {

constexpr double small_part = 0.02;  // of the largest part, prior-scaled: not worth naming

/// Direction over the prior-scaled layout, in words. The first parameter counts 1.
NamedDirection named(const Layout& layout, const VecX& scaled, std::string reason) {
  NamedDirection out;
  out.reason = std::move(reason);
  const double largest = scaled.cwiseAbs().maxCoeff();
  std::vector<std::size_t> states;  // library order: rate and readout parameters may alternate
  for (std::size_t k = 0; k < layout.size(); ++k)
    if (std::abs(scaled[k]) > small_part * largest) states.push_back(k);
  std::sort(states.begin(), states.end(),
            [&](std::size_t a, std::size_t b) { return layout.params[a] < layout.params[b]; });
  double first = 0.0;
  for (const std::size_t k : states) {
    const auto& spec = TermLibrary::specs[layout.params[k]];
    const double natural = scaled[k] * layout.sigma[k] / spec.unit.to_si;
    if (first == 0.0) first = natural;
    const double c = natural / first;
    out.parts.push_back({layout.params[k], c});
    if (!out.combination.empty()) out.combination += c < 0.0 ? " - " : " + ";
    const std::string size = number_text(std::abs(c));
    out.combination += (size == "1" ? "" : size + " ") + std::string(spec.key.view());
  }
  return out;
}

}  // namespace

std::vector<NamedDirection> name_degeneracies(const Layout& layout, const Mounting& mounting,
                                              const std::vector<WeakDirection>& directions) {
  std::vector<NamedDirection> all;
  if (directions.empty()) return all;
  const auto n = static_cast<Eigen::Index>(layout.size());
  const auto d = static_cast<Eigen::Index>(directions.size());
  MatX rows(d, n);  // orthonormal basis of the space
  for (Eigen::Index r = 0; r < d; ++r) rows.row(r) = directions[r].direction.transpose();
  const MatX space = rows;

  std::vector<bool> is_pivot(layout.size(), false);
  for (const KnownDegeneracy& known : known_degeneracies(layout, mounting)) {
    if (static_cast<Eigen::Index>(all.size()) == d) break;
    const VecX v = known.direction.normalized();
    if ((v - space.transpose() * (space * v)).norm() > known.tolerance) continue;
    // Take it out of the space: no other direction keeps its pivot. One that is made up of those
    // before has nothing left in the space to be taken out.
    VecX free = v;
    for (Eigen::Index k = 0; k < n; ++k)
      if (is_pivot[k]) free[k] = 0.0;
    Eigen::Index pivot = 0;
    if (free.cwiseAbs().maxCoeff(&pivot) < 0.1) continue;
    if (rows.col(pivot).norm() < 1e-3) continue;
    rows -= (rows.col(pivot) * (v.transpose() / v[pivot])).eval();
    is_pivot[pivot] = true;
    all.push_back(named(layout, v, known.reason));
  }

  std::vector<Eigen::Index> pivot_rows;
  std::vector<bool> used(directions.size(), false);
  while (static_cast<Eigen::Index>(all.size() + pivot_rows.size()) < d) {
    Eigen::Index row = -1, column = -1;
    double best = 1e-6;
    for (Eigen::Index r = 0; r < d; ++r)
      for (Eigen::Index k = 0; k < n; ++k)
        if (!used[r] && !is_pivot[k] && std::abs(rows(r, k)) > best) {
          best = std::abs(rows(r, k));
          row = r;
          column = k;
        }
    if (row < 0) break;
    rows.row(row) /= rows(row, column);
    for (Eigen::Index r = 0; r < d; ++r)
      if (r != row) rows.row(r) -= (rows(r, column) * rows.row(row)).eval();
    used[row] = true;
    is_pivot[column] = true;
    pivot_rows.push_back(row);
  }
  const std::size_t known = all.size();
  for (const Eigen::Index r : pivot_rows) {
    NamedDirection direction = named(layout, rows.row(r).transpose(), {});
    if (direction.parts.size() == 1) direction.reason = no_signal_reason(direction.parts[0].param);
    all.push_back(std::move(direction));
  }
  std::sort(
      all.begin() + static_cast<std::ptrdiff_t>(known), all.end(),
      [](const auto& a, const auto& b) { return a.parts.front().param < b.parts.front().param; });
  return all;
}

}  // namespace drift::report
