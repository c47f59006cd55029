#pragma once

#include <vector>

#include "core/estimate/sequential/in_lanes/lane_information.hpp"
#include "core/estimate/sequential/in_lanes/lane_stretch.hpp"

namespace drift {

/// Products of neighbouring residuals of the samples of stretches, at an estimate, less what the
/// fit makes of white ones: with rows J over attitude and parameters and their covariance P, those
/// of neighbours k, l have the covariance -J_k P J_l^T. The noise is white, so the attitude
/// anywhere follows from that at the end of the chain. Of several runs, one in each lane.
class LaneStretchLag {
 public:
  /// The test must outlive it.
  LaneStretchLag(const CompressedTest& test, std::size_t parameters, std::size_t rate,
                 const std::vector<LaneLinearizer::Entry>& readout);

  /// Where rows of interval i, a stretch, are to be worked out and kept.
  LaneStretch& stretch(std::size_t i) { return stretches_[i]; }
  /// Interval i, which is none: from its beginning to its end.
  void pass(std::size_t i, const PackMat& Phi, const std::vector<Pack>& G);
  /// Their sum. ends: the attitude at the end of each chain; moved: the parameters, from the
  /// reference; information: on them, factorised.
  Pack sum(const std::vector<LaneFilter>& ends, const std::vector<Pack>& moved,
           const LaneInformation& information, const LaneStretch::Sums& readings);

 private:
  void go_back(const PackMat& Phi, const std::vector<Pack>& G);
  Pack of_channel(std::size_t i, Reading what, const LaneFilter& end,
                  const std::vector<Pack>& moved, const LaneInformation& information,
                  const LaneStretch::Sums& readings);
  void rows_of_axis(const LaneStretch::Channel& channel, std::size_t axis, std::size_t first,
                    Pack* tiles) const;

  const CompressedTest& test_;
  std::size_t parameters_, rate_;
  const std::vector<LaneLinearizer::Entry>& readout_;
  std::vector<LaneStretch> stretches_;
  std::vector<PackMat> Phi_;  ///< of the intervals that are no stretches
  std::vector<std::vector<Pack>> G_;
  // psi at the beginning of an interval = M psi(end of the chain) + N x(rate states).
  PackMat M_;
  std::vector<Pack> N_;                   ///< three numbers of each rate state
  std::vector<Pack> by_parameter_;        ///< psi as the parameters have it, three numbers of each
  std::vector<std::vector<Pack>> white_;  ///< work: rows of an axis by fours, whitened
  std::vector<Pack> residual_;            ///< of an axis
  std::vector<PackVec> by_rest_;          ///< of its rows, by what the parameters do not say of psi
};

}  // namespace drift
