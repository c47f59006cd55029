#pragma once

#include "analysis/observability/information.hpp"
#include "core/estimate/sequential/interval_rows.hpp"

namespace drift::observability {

/// What a test tells of the parameters where something random drives its platform: rows that are
/// white given all that was measured before them. What has driven the platform, and its attitude
/// since the caging, are followed by the filter of the iterated estimator (AttitudeFilter), so
/// posteriors are those that its covariance ends with.
class DrivenRows {
 public:
  /// Linearised at model.nominal along the trajectory phi; process noise is that of the filter.
  /// What it refers to must outlive it.
  DrivenRows(const RankedModel& model, const Timeline& timeline, const Trajectory& phi);

  /// Of the intervals first to end - 1, which come in order: a triangle over the parameters, shape
  /// (n, n). measured: whether anything is read there. InputError (self_check) if a covariance is
  /// not positive definite.
  MatX take(std::size_t first, std::size_t end, bool measured);
  /// At the end of the last one.
  Walked walked() const;

 private:
  const Timeline& timeline_;
  const Trajectory& phi_;
  IntervalRows rows_;
};

}  // namespace drift::observability
