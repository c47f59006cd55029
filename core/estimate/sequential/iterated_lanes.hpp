#pragma once

#include <span>

#include "core/estimate/sequential/iterated_estimate.hpp"
#include "core/estimate/sequential/lane_filter.hpp"
#include "core/sim/measurements.hpp"

namespace drift {

/// A recording, where an estimate of it begins, and then the estimate (IteratedPasses).
class IteratedJob : public IteratedEstimate {
 public:
  const Measurements* measured = nullptr;
  Theta start = Theta::Zero();

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
  static constexpr std::size_t width = static_cast<std::size_t>(Pack::width);
  /// Whether a filter and a timeline are such: terms that ask for attitude and command alone and do
  /// not act on the gimbals, nothing that walks, attitude included, no outliers, no
  /// rest.
  static bool can(const FilterSpec& filter, const Timeline& timeline);

  /// The timeline must outlive it.
  IteratedLanes(const FilterSpec& filter, const Timeline& timeline, const Readout& readout);

  /// Allocates nothing once every job has been run.
  void run(std::span<IteratedJob> jobs);

 private:
  enum class Pass { first, linear };
  enum Channel { accelerometers = 0, gimbals = 1 };

  void prepare(IteratedJob& job) const;
  void load(std::span<IteratedJob* const> jobs);
  void set_theta();
  void begin();
  void linear_pass();
  void settle(std::size_t lane);
  void finish(IteratedJob& job, int lane);
  void take(std::size_t i, bool shared, Pass pass);
  void linearize(std::size_t i, bool shared);
  void take_accelerometers(std::size_t i, Pass pass);
  void take_gimbals(std::size_t i, Pass pass);
  void take_scalars(std::size_t i, Channel channel, LaneFilter::Scalars& scalars, Pass pass);
  void read(const Mat3X Measurements::*what, std::size_t i, LaneFilter::Scalars& scalars) const;
  void solve_block(const Interval& interval, PackVec& phi);
  void cage(const Interval& interval, const PackVec& phi);
  void diverged(std::size_t lane, bool finite, double t, Pass pass);

  FilterSpec filter_;
  const Timeline& timeline_;
  Readout readout_;
  Layout layout_;
  LaneLinearizer linearizer_;
  LaneFilter attitude_;
  LaneInformation information_;
  Information one_;  ///< that of a lane
  std::array<IteratedJob*, width> lanes_{};
  std::size_t used_ = 0;  ///< lanes; in the others is the last job once more
  std::vector<LaneJacobian> jacobian_;
  std::vector<PackMat> Phi_;
  std::vector<std::vector<Pack>> G_;
  std::vector<Pack> H_rate_, H_par_, rest_G_;
  std::vector<PackVec> path_;
  std::vector<LaneFilter> ends_;
  std::vector<Pack> x_, x_start_, moved_, step_, prior_;
  std::vector<IteratedJob*> waiting_;
};

}  // namespace drift
