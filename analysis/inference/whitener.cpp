#include "analysis/inference/whitener.hpp"

#include <algorithm>

#include "core/estimate/lanes.hpp"

namespace drift::inference {
namespace {

using Go = void (NoiseFilter::*)(NoiseFilter::Columns&, const double*, double*, Eigen::Index) const;

/// Calls each(row, column) for all of a part, a cache line of columns at a time: one side has its
/// columns together, the other its rows.
template <class Each>
void for_tiles(Eigen::Index rows, Eigen::Index columns, Each&& each) {
  constexpr Eigen::Index line = 8;
  for (Eigen::Index first = 0; first < columns; first += line)
    for (Eigen::Index r = 0; r < rows; ++r)
      for (Eigen::Index c = first; c < std::min(first + line, columns); ++c) each(r, c);
}

MatX through(const NoiseFilter& filter, Go go, MatX columns, Eigen::Index first) {
  constexpr Eigen::Index at_once = 64;  // rows: they stay in the cache
  const std::size_t width = whole_lanes(static_cast<std::size_t>(columns.cols()));
  NoiseFilter::Columns at = filter.begin(width, first);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> part =
      MatX::Zero(at_once, static_cast<Eigen::Index>(width));
  for (Eigen::Index start = 0; start < columns.rows(); start += at_once) {
    const Eigen::Index count = std::min(at_once, columns.rows() - start);
    for_tiles(count, columns.cols(), [&](auto r, auto c) { part(r, c) = columns(start + r, c); });
    (filter.*go)(at, part.data(), part.data(), count);
    for_tiles(count, columns.cols(), [&](auto r, auto c) { columns(start + r, c) = part(r, c); });
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
