#include "core/stats/lag_sum.hpp"

#include <algorithm>
#include <cmath>

namespace drift::stats {
namespace {

constexpr double close = 12.0;  // numbers next to a bend that are taken one by one
constexpr double growth = 0.4;  // length of a stretch over its distance from the bend

void add_stretch(std::vector<LagNode>& nodes, double from, double to) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  const double away = half * std::sqrt(0.6);
  nodes.push_back({middle - away, half * 5.0 / 9.0});
  nodes.push_back({middle, half * 8.0 / 9.0});
  nodes.push_back({middle + away, half * 5.0 / 9.0});
}

/// Stretches from `from` (at a distance `away` from its bend) to `to`, towards `to` or from it.
void add_growing(std::vector<LagNode>& nodes, double from, double to) {
  const double sign = to > from ? 1.0 : -1.0;
  double at = from, away = close;
  while (sign * (to - at) > 0.0) {
    double next = at + sign * growth * away;
    if (sign * (to - next) < 0.3 * growth * away) next = to;  // no crumb at the end
    add_stretch(nodes, std::min(at, next), std::max(at, next));
    away += std::abs(next - at);
    at = next;
  }
}

/// The numbers from `from` up to but not including `to`, both bends.
void add_between(std::vector<LagNode>& nodes, double from, double to) {
  if (to - from <= 4.0 * close) {
    for (double lag = from; lag < to; lag += 1.0) nodes.push_back({lag});
    return;
  }
  for (double k = 0.0; k < close; k += 1.0) nodes.push_back({from + k});
  for (double k = 1.0; k < close; k += 1.0) nodes.push_back({to - k});
  const double begin = from + close - 0.5, end = to - close + 0.5, middle = 0.5 * (begin + end);
  add_growing(nodes, begin, middle);
  add_growing(nodes, end, middle);
}

}  // namespace

std::vector<LagNode> lag_nodes(std::span<const double> bends) {
  std::vector<LagNode> nodes;
  for (std::size_t k = 1; k < bends.size(); ++k) add_between(nodes, bends[k - 1], bends[k]);
  if (!bends.empty()) nodes.push_back({bends.back()});
  return nodes;
}

}  // namespace drift::stats
