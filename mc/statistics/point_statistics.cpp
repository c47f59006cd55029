#include "mc/statistics/point_statistics.hpp"

#include "core/base/check.hpp"

namespace drift::mc {

PointStatistics::PointStatistics(const Study& study) : columns_(study), failures_(columns_, study) {
  for (const auto& filter : columns_.filters)
    filters_.emplace_back(filter, HealthRules{study.monte_carlo.healthy_sigma, 5.0});
}

void PointStatistics::add(const Block& block) {
  const std::size_t width = columns_.count;
  DRIFT_DEMAND(block.rows.size() == block.status.size() * width);
  for (std::size_t i = 0; i < block.status.size(); ++i) {
    const std::uint64_t run = block.first + i;
    const std::span<const double> row(&block.rows[i * width], width);
    const RunStatus status = block.status[i];
    ++runs_;
    failures_.add(status, run, row);
    if (status != RunStatus::ok && status != RunStatus::filter_diverged) continue;
    for (FilterStatistics& filter : filters_) filter.add(row);
  }
}

}  // namespace drift::mc
