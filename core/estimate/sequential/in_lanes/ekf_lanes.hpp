#pragma once

#include <span>

#include "core/estimate/sequential/ekf.hpp"
#include "core/estimate/sequential/filter_estimate.hpp"
#include "core/estimate/sequential/in_lanes/lane_covariance.hpp"
#include "core/estimate/sequential/in_lanes/lane_intervals.hpp"

namespace drift {

/// A recording, where an estimate of it begins, and then the estimate (Ekf).
class EkfJob : public FilterEstimate {
 public:
  const Measurements* measured = nullptr;
  Theta start = Theta::Zero();

 private:
  friend class EkfLanes;
};

/// The extended Kalman filter (Ekf) of several recordings of one plan in lock step: as many as the
/// machine has lanes, each in one of its own. The filter of the attitude sees the parameters as
/// known, its innovations hang on them (LaneIntervals); their covariance takes these in as they
/// come, and all that follows is linearised about the estimate. What comes out of a job does not
/// depend on the others, to the last bit; against Ekf it is rounded otherwise.
class EkfLanes {
 public:
  static constexpr std::size_t width = LaneIntervals::width;
  /// The timeline must outlive it.
  EkfLanes(const FilterSpec& filter, const Timeline& timeline, const Readout& readout);

  /// Allocates nothing once every job has been run. ContractError if a recording has other columns
  /// than the timeline intervals.
  void run(std::span<EkfJob> jobs);
  /// The same, and how each of them went.
  void run(std::span<EkfJob> jobs, std::span<EkfHistory> histories);

 private:
  using Channel = LaneIntervals::Channel;
  void run_pack(std::span<EkfJob> jobs, std::span<EkfHistory> histories);
  void begin(std::span<EkfJob> jobs);
  void take(const Interval& interval, std::size_t node, Channel channel,
            LaneFilter::Scalars scalars);
  void notice_divergence(double t);
  void finish();
  void begin(EkfHistory& history) const;
  void keep(std::size_t i, std::size_t lane, EkfHistory& history);

  LaneIntervals along_;
  const Timeline& timeline_;
  LaneCovariance P_;
  std::vector<Pack> x_, step_;
  std::span<EkfJob> lanes_;  ///< as many as are used; in the others is the last once more
  LaneIntervals::Recordings recordings_{};
  Pack nis_, lagged_, scalars_, pairs_;
  /// Of the last sample of a channel: innovations whitened, and whether they were measured.
  struct Before {
    PackVec white = PackVec::Zero(), on = PackVec::Zero();
  };
  std::array<Before, 2> before_;
};

}  // namespace drift
