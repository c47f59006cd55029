#pragma once

#include <array>
#include <vector>

#include "core/estimate/sequential/in_lanes/lane_stretch.hpp"
#include "core/sim/measurements.hpp"

namespace drift {

/// What several runs of one plan, one in each lane, go through interval after interval: the path,
/// its linearisation, the filter of the attitude, and what is measured (IntervalRows, in lanes).
/// What comes out of a lane does not depend on its neighbours.
class LaneIntervals {
 public:
  static constexpr std::size_t width = static_cast<std::size_t>(Pack::width);
  enum Channel { accelerometers = 0, gimbals = 1 };
  using Recordings = std::array<const Measurements*, width>;

  /// Whether a filter and a timeline are such: terms that LaneLinearizer can, nothing that walks,
  /// attitude included, no outliers, no rest.
  static bool can(const FilterSpec& filter, const Timeline& timeline);
  /// The timeline must outlive it.
  LaneIntervals(const FilterSpec& filter, const Timeline& timeline, const Readout& readout);
  /// Of a timeline with stretches, which must outlive it too.
  LaneIntervals(const FilterSpec& filter, const CompressedTest& test, const Readout& readout);
  LaneIntervals(const LaneIntervals&) = delete;
  LaneIntervals& operator=(const LaneIntervals&) = delete;

  const Layout& layout() const { return layout_; }
  const Timeline& timeline() const { return timeline_; }
  const Readout& readout() const { return readout_; }
  /// A slot of the accelerometers and the readout state it depends on.
  const std::vector<LaneLinearizer::Entry>& readout_states() const { return linearizer_.readout(); }
  LaneFilter& attitude() { return attitude_; }
  const LaneFilter& attitude() const { return attitude_; }
  /// Whether interval i is a stretch; the first sample of it, and how many it stands for.
  bool is_stretch(std::size_t i) const { return compressed_ && compressed_->readings(i); }
  std::size_t first_sample(std::size_t i) const { return compressed_ ? compressed_->first(i) : i; }
  std::size_t samples(std::size_t i) const { return compressed_ ? compressed_->samples(i) : 1; }
  /// Rotation vectors at every node of the timeline [rad].
  PackVec& phi(std::size_t node) { return path_[node]; }

  /// The rotation vector at a node, turned on by psi (trajectory.hpp) [rad].
  PackVec turned(std::size_t node, const PackVec& psi, const PackVec& phi) const;

  /// All that follows is about parameters x off the prior means, in prior sigmas.
  void set_theta(const std::vector<Pack>& x);
  /// The attitude is new, and expected where the interval is to begin at its nominal one.
  void cage(const Interval& interval);
  /// The path through an interval, from one of its nodes on, or back from its last.
  void forward(const Interval& interval, std::size_t from = 0) {
    linearizer_.forward(timeline_, interval, &path_[interval.first_node], from);
  }
  void backward(const Interval& interval) {
    linearizer_.backward(timeline_, interval, &path_[interval.first_node]);
  }
  /// Jacobians along the path of interval i. follows: it goes on where the one before has ended,
  /// which was linearised about the same.
  void linearize(std::size_t i, bool follows);
  /// The same of a stretch, and its rows.
  void linearize(std::size_t i, bool follows, const LaneStretch::Sums& readings,
                 LaneStretch& stretch);
  /// From the beginning of interval i, which was linearised last, to its end.
  const PackMat& Phi(std::size_t i) const { return Phi_[timeline_.intervals[i].node_count() - 1]; }
  const std::vector<Pack>& G(std::size_t i) const {
    return G_[timeline_.intervals[i].node_count() - 1];
  }
  /// The filter of the attitude comes to the middle of the interval, then to its end.
  void to_middle(const Interval& interval);
  void to_end(const Interval& interval);
  /// From its beginning to its end, where nothing is read on the way.
  void through(const Interval& interval);
  /// What was read in interval i, to be taken in at its middle and at its end. What no lane has
  /// measured is taken in as well: how rows come together must not hang on which runs do.
  LaneFilter::Scalars read_accelerometers(std::size_t i, const Recordings& recordings);
  LaneFilter::Scalars read_gimbals(std::size_t i, const Recordings& recordings);

 private:
  LaneIntervals(const FilterSpec& filter, const Timeline& timeline,
                const CompressedTest* compressed, const Readout& readout);
  void evaluate(std::size_t i, bool follows);

  FilterSpec filter_;
  const Timeline& timeline_;
  const CompressedTest* compressed_;  ///< null: every interval is a sample
  Readout readout_;
  Layout layout_;
  LaneLinearizer linearizer_;
  bool see_more_;  ///< the terms, than attitude and command
  LaneFilter attitude_;
  std::vector<LaneJacobian> jacobian_;
  std::vector<PackMat> Phi_, weighted_H_;
  std::vector<std::vector<Pack>> G_;  ///< zero at the first node
  std::vector<Pack> weight_;          ///< of the nodes of an interval
  std::vector<Pack> H_rate_, H_par_, rest_G_;
  std::vector<PackVec> path_;
};

}  // namespace drift
