#pragma once

#include <span>

#include "core/estimate/sequential/filter_estimate.hpp"
#include "core/estimate/sequential/in_lanes/lane_information.hpp"
#include "core/estimate/sequential/in_lanes/lane_intervals.hpp"

namespace drift {

/// A recording, where an estimate of it begins, and then the estimate (IteratedPasses).
class IteratedJob : public FilterEstimate {
 public:
  const Measurements* measured = nullptr;
  Theta start = Theta::Zero();
  int linear_passes() const { return passes_; }

 private:
  friend class IteratedLanes;
  std::size_t pairs_ = 0;
  int passes_ = 0;
  bool done_ = false;
  VecX x_start_, moved_;
  std::vector<Vec3> ends_;  ///< rotation vector at the end of each chain [rad]
};

/// The iterated estimator (IteratedPasses) of several recordings of one plan in lock step: as many
/// as the machine has lanes, each in one of its own. After a pass those that need another are put
/// together again. What comes out of a job does not depend on the others, to the last bit; against
/// IteratedPasses it is rounded otherwise.
class IteratedLanes {
 public:
  static constexpr std::size_t width = LaneIntervals::width;
  /// The timeline must outlive it.
  IteratedLanes(const FilterSpec& filter, const Timeline& timeline, const Readout& readout);

  /// Allocates nothing once every job has been run.
  void run(std::span<IteratedJob> jobs);

 private:
  enum class Pass { first, linear };
  void prepare(IteratedJob& job) const;
  void load(std::span<IteratedJob* const> jobs);
  void begin();
  void linear_pass();
  void settle();
  void settle(IteratedJob& job, std::size_t lane);
  void take(std::size_t i, bool follows, Pass pass);
  void take_scalars(const Interval& interval, LaneIntervals::Channel channel,
                    LaneFilter::Scalars scalars, Pass pass);
  void solve_block(const Interval& interval, PackVec& phi);
  void diverged(std::size_t lane, bool finite, double t, Pass pass);

  LaneIntervals along_;
  const Timeline& timeline_;
  const Layout& layout_;
  LaneFilter& attitude_;
  LaneInformation information_;
  std::array<IteratedJob*, width> lanes_{};
  std::size_t used_ = 0;  ///< lanes; in the others is the last job once more
  LaneIntervals::Recordings recordings_{};
  std::array<MatX*, width> covariances_{};
  std::vector<LaneFilter> ends_;
  std::vector<Pack> x_, x_start_, moved_, step_, prior_;
  Pack lagged_;
  std::vector<IteratedJob*> waiting_;
};

}  // namespace drift
