#include "mc/statistics/stop_rule.hpp"

#include <algorithm>
#include <limits>

#include "core/stats/normal.hpp"

namespace drift::mc {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double width_of(const FilterStatistics& filter, const StopSpec& spec, double z) {
  if (spec.quantity == "silent_failure_rate") return filter.starts().front().silent.half_width(z);
  const std::string key = spec.quantity.substr(std::string("rmse.").size());
  const auto& params = filter.columns().layout.params;
  for (std::size_t k = 0; k < params.size(); ++k) {
    if (TermLibrary::specs[params[k]].key.view() != key) continue;
    const ErrorStatistics& e = filter.errors()[k];
    const double width = e.rmse(spec.confidence).half_width() / e.prior_sigma();
    return width >= 0.0 ? width : infinite;
  }
  return -1.0;  // a filter that does not estimate it waits for nothing
}

}  // namespace

HalfWidthRule::HalfWidthRule(const std::vector<StudyPoint>& points, const StopSpec& spec)
    : spec_(spec), z_(stats::normal_half_width(spec.confidence)) {
  for (const StudyPoint& p : points) points_.push_back({PointStatistics(p.study), 0});
}

double HalfWidthRule::half_width(std::size_t point) const {
  double widest = -1.0;
  for (const FilterStatistics& f : points_[point].statistics.filters())
    widest = std::max(widest, width_of(f, spec_, z_));
  return widest >= 0.0 ? widest : infinite;  // nobody estimates it: no number of runs is enough
}

bool HalfWidthRule::enough(const Block& block) {
  Point& point = points_[block.point];
  point.statistics.add(block);
  return ++point.blocks >= 2 && half_width(block.point) <= spec_.half_width;
}

std::unique_ptr<StopRule> stop_rule(const std::vector<StudyPoint>& points) {
  if (points.empty() || !points.front().study.monte_carlo.stop) return nullptr;
  return std::make_unique<HalfWidthRule>(points, *points.front().study.monte_carlo.stop);
}

}  // namespace drift::mc
