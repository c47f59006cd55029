#pragma once

#include <memory>
#include <span>

#include "core/estimate/sequential/filter_estimate.hpp"
#include "core/estimate/sequential/in_lanes/iterated_stretches.hpp"
#include "core/estimate/sequential/in_lanes/lane_information.hpp"

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
  double tail_ = 0.0;          ///< of the last pass (LaneStretch)
  std::size_t recording_ = 0;  ///< which of those in hand (IteratedStretches)
  VecX x_start_, moved_;
  std::vector<Vec3> ends_;  ///< rotation vector at the end of each chain [rad]
};

/// The iterated estimator (IteratedPasses) of several recordings of one plan in lock step: as many
/// as the machine has lanes, each in one of its own. After a pass those that need another are put
/// together again. What comes out of a job does not depend on the others, to the last bit; against
/// IteratedPasses it is rounded otherwise. Long stretches are seen through polynomials
/// (CompressedTest); a recording for which that is too rough, or in which a sample of a stretch is
/// missing, is seen sample by sample.
class IteratedLanes {
 public:
  static constexpr std::size_t width = LaneIntervals::width;
  /// The timeline must outlive it.
  IteratedLanes(const FilterSpec& filter, const Timeline& timeline, const Readout& readout);

  /// Allocates nothing once every job has been run. ContractError if a recording has other columns
  /// than the timeline intervals.
  void run(std::span<IteratedJob> jobs);
  /// Whether some stretch is seen through polynomials.
  bool compressed() const { return stretches_ != nullptr; }

 private:
  enum class Pass { first, linear };
  using Jobs = std::vector<IteratedJob*>;
  IteratedLanes(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                std::unique_ptr<IteratedStretches> stretches);
  void run(const Jobs& jobs);
  void prepare(IteratedJob& job) const;
  void load(std::span<IteratedJob* const> jobs);
  void begin();
  void linear_pass();
  void settle();
  void settle(IteratedJob& job, std::size_t lane);
  void report(IteratedJob& job, std::size_t lane);
  void take(LaneIntervals& along, std::size_t i, bool follows, Pass pass);
  void take_stretch(LaneIntervals& along, std::size_t i, bool follows, Pass pass);
  void take_scalars(LaneIntervals& along, LaneIntervals::Channel channel, bool follows,
                    LaneFilter::Scalars scalars, Pass pass);
  void solve_block(LaneIntervals& along, const Interval& interval, PackVec& phi);
  void diverged(std::size_t lane, bool finite, double t, Pass pass);

  FilterSpec filter_;
  const Timeline& timeline_;   ///< sample by sample
  std::vector<bool> goes_on_;  ///< whether a sample is seen as the neighbour of the one before
  std::unique_ptr<IteratedStretches> stretches_;  ///< null: every interval is a sample
  LaneIntervals along_;
  const Layout& layout_;
  LaneInformation information_;
  std::array<IteratedJob*, width> lanes_{};
  std::size_t used_ = 0;  ///< lanes; in the others is the last job once more
  LaneIntervals::Recordings recordings_{};
  std::array<MatX*, width> covariances_{};
  std::vector<LaneFilter> ends_;
  std::vector<Pack> x_, x_start_, moved_, step_, prior_;
  Pack tail_, lagged_;
  Jobs jobs_, waiting_;
  Jobs rough_;  ///< for which stretches do not do
  std::unique_ptr<IteratedLanes> sample_by_sample_;
};

}  // namespace drift
