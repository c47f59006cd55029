#pragma once

#include <memory>
#include <vector>

#include "mc/statistics/point_statistics.hpp"
#include "mc/study/sweep.hpp"

namespace drift::mc {

/// [monte_carlo] stop: a point has enough runs when, for every filter, the interval of the quantity
/// is narrower than asked for. A pure function of the blocks so far, at least two of them.
///
/// A rule that looks after every block stops a little early when luck makes the interval narrow;
/// the coverage it costs is below a percent for half widths asked for in advance (Chow and Robbins
/// 1965: the fixed-width procedure has the nominal coverage in the limit).
class HalfWidthRule final : public StopRule {
 public:
  HalfWidthRule(const std::vector<StudyPoint>& points, const StopSpec& spec);
  bool enough(const Block& block) override;

  /// Half width reached at a point, the widest of its filters.
  double half_width(std::size_t point) const;

 private:
  StopSpec spec_;
  double z_;
  struct Point {
    PointStatistics statistics;
    std::size_t blocks = 0;
  };
  std::vector<Point> points_;
};

/// The rule of a study; null if it asks for none.
std::unique_ptr<StopRule> stop_rule(const std::vector<StudyPoint>& points);

}  // namespace drift::mc
