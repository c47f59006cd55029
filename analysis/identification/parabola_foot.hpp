#pragma once

#include <cmath>
#include <optional>
#include <vector>

namespace drift::identification {

/// Where the parabola through the costs (2 log L) at -h, 0 and h has its foot, how wide it is
/// (1 sigma), and by how much it falls from 0 to there.
struct ParabolaFoot {
  double at = 0.0, sigma = 0.0, fall = 0.0;
};

/// Nothing where there is no valley.
inline std::optional<ParabolaFoot> foot_of(const std::vector<double>& costs, double h) {
  const double bend = costs[0] + costs[2] - 2.0 * costs[1], slope = costs[0] - costs[2];
  if (!(bend > 0.0)) return std::nullopt;
  return ParabolaFoot{0.5 * h * slope / bend, h * std::sqrt(2.0 / bend),
                      slope * slope / (8.0 * bend)};
}

}  // namespace drift::identification
