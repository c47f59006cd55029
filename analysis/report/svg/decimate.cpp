#include "analysis/report/svg/decimate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace drift::report {

std::vector<std::size_t> decimated(std::span<const double> y, std::size_t most) {
  std::vector<std::size_t> kept;
  if (y.size() <= most) {
    kept.resize(y.size());
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    return kept;
  }
  const std::size_t stretches = std::max<std::size_t>(most / 3, 1);
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t begin = s * y.size() / stretches, end = (s + 1) * y.size() / stretches;
    std::size_t lowest = end, highest = end, hole = end;
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isfinite(y[i])) {
        if (hole == end) hole = i;
        continue;
      }
      if (lowest == end || y[i] < y[lowest]) lowest = i;
      if (highest == end || y[i] > y[highest]) highest = i;
    }
    std::vector<std::size_t> of_stretch;
    for (const std::size_t i : {lowest, highest, hole})
      if (i != end) of_stretch.push_back(i);
    std::sort(of_stretch.begin(), of_stretch.end());
    of_stretch.erase(std::unique(of_stretch.begin(), of_stretch.end()), of_stretch.end());
    kept.insert(kept.end(), of_stretch.begin(), of_stretch.end());
  }
  return kept;
}

}  // namespace drift::report
