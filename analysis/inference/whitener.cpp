#include "analysis/inference/whitener.hpp"

#include <algorithm>
#include <vector>

#include "core/estimate/lanes.hpp"

namespace drift::inference {
namespace {

using Go = void (NoiseFilter::*)(NoiseFilter::Columns&, const double*, double*, Eigen::Index) const;

/// Calls each(row, column) for all of a part, squares of a cache line by a cache line at a time:
/// one side has its columns together, the other its rows.
template <class Each>
void for_tiles(Eigen::Index rows, Eigen::Index columns, Each&& each) {
  constexpr Eigen::Index line = 8;
  for (Eigen::Index c = 0; c < columns; c += line)
    for (Eigen::Index r = 0; r < rows; r += line)
      if (c + line <= columns && r + line <= rows) {
#pragma GCC unroll 8
        for (Eigen::Index i = 0; i < line; ++i)
#pragma GCC unroll 8
          for (Eigen::Index k = 0; k < line; ++k) each(r + i, c + k);
      } else {
        for (Eigen::Index i = r; i < std::min(r + line, rows); ++i)
          for (Eigen::Index k = c; k < std::min(c + line, columns); ++k) each(i, k);
      }
}

MatX through(const NoiseFilter& filter, Go go, MatX columns, Eigen::Index first) {
  constexpr Eigen::Index at_once = 64;  // rows: they stay in the cache
  const std::size_t width = whole_lanes(static_cast<std::size_t>(columns.cols()));
  NoiseFilter::Columns at = filter.begin(width, first);
  std::vector<double> rows(static_cast<std::size_t>(at_once) * width, 0.0);
  double *const part = rows.data(), *const all = columns.data();
  const auto wide = static_cast<Eigen::Index>(width), high = columns.rows();
  for (Eigen::Index start = 0; start < high; start += at_once) {
    const Eigen::Index count = std::min(at_once, high - start);
    for_tiles(count, columns.cols(), [=](Eigen::Index r, Eigen::Index c) {
      part[r * wide + c] = all[c * high + start + r];
    });
    (filter.*go)(at, part, part, count);
    for_tiles(count, columns.cols(), [=](Eigen::Index r, Eigen::Index c) {
      all[c * high + start + r] = part[r * wide + c];
    });
  }
  return columns;
}

}  // namespace

MatX Whitener::apply(MatX columns, Eigen::Index first) const {
  return through(filter_, &NoiseFilter::whiten, std::move(columns), first);
}

MatX Whitener::colour(MatX white) const {
  return through(filter_, &NoiseFilter::colour, std::move(white), 0);
}

}  // namespace drift::inference
