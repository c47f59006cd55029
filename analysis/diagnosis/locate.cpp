#include "analysis/diagnosis/locate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace drift::diagnosis {
namespace {

constexpr const char* channel_names[inference::num_channels] = {
    "acc_x", "acc_y", "acc_z", "gimbal_outer", "gimbal_middle", "gimbal_inner"};

/// Sums over the rows of one channel, position or cell.
struct Sum {
  double product = 0.0, signature2 = 0.0, residual2 = 0.0, rows = 0.0;
  bool of_excess = false;  ///< no signature is known
  void add(std::optional<double> s, double r) {
    of_excess = !s;
    product += s.value_or(0.0) * r;
    signature2 += s.value_or(0.0) * s.value_or(0.0);
    residual2 += r * r;
    rows += 1.0;
  }
  /// What is shared out: its product with a signature, whose noise is the signature's length; else
  /// what chi-square is above its rows, of variance 2 each.
  double part() const { return of_excess ? residual2 - rows : product; }
  double part_sigma() const { return std::sqrt(of_excess ? 2.0 * rows : signature2); }
  double chi2_per_dof() const { return rows > 0.0 ? residual2 / rows : 1.0; }
  double z() const { return rows > 0.0 ? (residual2 / rows - 1.0) * std::sqrt(0.5 * rows) : 0.0; }
};

/// Shares of the positive parts, so that they sum to one; sigma from the noise of the part.
Share make_share(const Sum& s, double total) {
  Share out;
  out.share = total > 0.0 ? std::max(0.0, s.part()) / total : 0.0;
  out.sigma = total > 0.0 ? s.part_sigma() / total : 0.0;
  out.chi2_per_dof = s.chi2_per_dof();
  out.z = s.z();
  return out;
}

double positive_total(const auto& sums) {
  double total = 0.0;
  for (const auto& [key, s] : sums) total += std::max(0.0, s.part());
  return total;
}

void sort_by_share(std::vector<Share>& shares) {
  std::stable_sort(shares.begin(), shares.end(),
                   [](const Share& a, const Share& b) { return a.share > b.share; });
}

}  // namespace

const inference::Window* strongest_window(const search::Fitted& e) {
  const inference::Window* best = nullptr;
  double T = 0.0;
  for (const inference::PositionScan& s : e.scans)
    for (std::size_t k = 0; k < s.windows.size(); ++k)
      if (s.T[k] > T) {
        T = s.T[k];
        best = &s.windows[k];
      }
  return best;
}

VecX signature_of(const inference::Projector& projector,
                  const std::vector<std::pair<int, double>>& cause) {
  std::vector<int> columns;
  VecX amplitude(cause.size());
  for (std::size_t k = 0; k < cause.size(); ++k) {
    columns.push_back(cause[k].first);
    amplitude[k] = cause[k].second;
  }
  return projector.clean_extra(columns) * amplitude;
}

Where locate(const search::Fitted& e, const search::ChanceThresholds& thresholds,
             const std::optional<VecX>& signature, std::size_t most_windows) {
  Where out;
  out.channel_names.assign(std::begin(channel_names), std::end(channel_names));
  const VecX residual = e.projector->clean_residual();
  std::map<int, Sum> channels, positions;
  std::map<std::pair<int, int>, Sum> cells;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    const inference::RowTag& t = e.problem.tags[k];
    const std::optional<double> s = signature ? std::optional((*signature)[k]) : std::nullopt;
    channels[t.channel].add(s, residual[k]);
    positions[t.position].add(s, residual[k]);
    cells[{t.position, t.channel}].add(s, residual[k]);
  }
  double total = positive_total(channels);
  for (const auto& [channel, s] : channels) {
    out.channels.push_back(make_share(s, total));
    out.channels.back().name = channel_names[channel];
  }
  total = positive_total(positions);
  for (const auto& [position, s] : positions) {
    out.positions.push_back(make_share(s, total));
    out.positions.back().position = position + 1;
  }
  total = positive_total(cells);
  for (const auto& [cell, s] : cells)
    out.heat.push_back(
        {cell.first + 1, cell.second, total > 0.0 ? s.part() / total : 0.0, s.chi2_per_dof()});
  sort_by_share(out.channels);
  sort_by_share(out.positions);

  std::vector<ScanHit> hits;
  for (const inference::PositionScan& scan : e.scans)
    for (std::size_t k = 0; k < scan.windows.size(); ++k) {
      ++out.windows_tried;
      const double s = stats::strength(scan.T[k], 1);
      if (s < thresholds.scan_threshold) continue;
      const inference::Window& w = scan.windows[k];
      ScanHit hit;
      hit.equation = inference::equation_name(w.equation, w.axis);
      hit.position = w.position + 1;
      hit.start_s = w.start_s;
      hit.end_s = w.end_s;
      const double C = scan.scan.C(k, k);
      hit.amplitude = scan.scan.g[k] / C * w.unit;
      hit.sigma = w.unit / std::sqrt(C);
      hit.T = scan.T[k];
      hit.p_value = thresholds.scan.p_value(s);
      hits.push_back(hit);
    }
  std::stable_sort(hits.begin(), hits.end(),
                   [](const ScanHit& a, const ScanHit& b) { return a.T > b.T; });
  for (const ScanHit& h : hits) {
    const bool overlaps =
        std::any_of(out.windows.begin(), out.windows.end(), [&](const ScanHit& o) {
          return o.position == h.position && o.start_s < h.end_s && h.start_s < o.end_s;
        });
    if (!overlaps && out.windows.size() < most_windows) out.windows.push_back(h);
  }
  double strongest = 0.0;
  for (const inference::PositionScan& s : e.scans)
    for (const double T : s.T) strongest = std::max(strongest, stats::strength(T, 1));
  out.scan_p_value = thresholds.scan.p_value(strongest);
  return out;
}

}  // namespace drift::diagnosis
