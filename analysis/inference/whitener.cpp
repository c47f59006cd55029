#include "analysis/inference/whitener.hpp"

#include <algorithm>

#include "core/estimate/lanes.hpp"

namespace drift::inference {
namespace {

using Go = void (NoiseFilter::*)(NoiseFilter::Columns&, const double*, double*, Eigen::Index) const;

MatX through(const NoiseFilter& filter, Go go, MatX columns, Eigen::Index first) {
  constexpr Eigen::Index at_once = 64;  // rows: they stay in the cache
  const std::size_t width = whole_lanes(static_cast<std::size_t>(columns.cols()));
  NoiseFilter::Columns at = filter.begin(width, first);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> part =
      MatX::Zero(at_once, static_cast<Eigen::Index>(width));
  for (Eigen::Index start = 0; start < columns.rows(); start += at_once) {
    const Eigen::Index count = std::min(at_once, columns.rows() - start);
    part.topLeftCorner(count, columns.cols()) = columns.middleRows(start, count);
    (filter.*go)(at, part.data(), part.data(), count);
    columns.middleRows(start, count) = part.topLeftCorner(count, columns.cols());
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
