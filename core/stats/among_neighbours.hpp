#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace drift::stats {

/// How a sample stands among those around it.
struct AmongNeighbours {
  double size = 0.0;    ///< how far it is from their median
  double spread = 0.0;  ///< their range
};

/// The size that is usual among four neighbours, the median over normal samples, for 1 sigma of
/// them: normal samples are 1.14 sigma (rms) from the median of four others.
inline constexpr double usual_size_among_four = 0.6745 * 1.14;

/// Of at least three samples around, whose order is changed; the range without that of them which
/// is farthest from their median, if it may be astray as well.
inline AmongNeighbours among_neighbours(double x, std::vector<double>& around,
                                        bool without_farthest) {
  std::ranges::sort(around);
  const std::size_t n = around.size();
  const double median = 0.5 * (around[n / 2] + around[(n - 1) / 2]), least = around.front(),
               most = around.back();
  AmongNeighbours out{std::abs(x - median), most - least};
  if (without_farthest)
    out.spread = most - median > median - least ? around[n - 2] - least : most - around[1];
  return out;
}

}  // namespace drift::stats
