#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/estimate/sequential/in_lanes/lane_intervals.hpp"
#include "core/estimate/sequential/in_lanes/lane_stretch_lag.hpp"

namespace drift {

/// What IteratedLanes sees through polynomials (CompressedTest), and what the recordings in hand
/// say of it. Its linear passes see stretches as long as they are; the first one, which looks anew
/// block by block, sees them in pieces.
class IteratedStretches {
 public:
  /// Null where no stretch is worth it. The timeline must outlive it.
  static std::unique_ptr<IteratedStretches> of(const FilterSpec& filter, const Timeline& timeline,
                                               const Readout& readout);
  IteratedStretches(const FilterSpec& filter, const Timeline& timeline, const Readout& readout);
  IteratedStretches(const IteratedStretches&) = delete;
  IteratedStretches& operator=(const IteratedStretches&) = delete;

  const CompressedTest& whole() const { return whole_; }
  LaneIntervals& first_pass() { return first_; }
  LaneStretchLag& lag() { return lag_; }
  /// Where the rows of a piece are worked out.
  LaneStretch& piece() { return piece_; }

  void forget_recordings() { recordings_ = 0; }
  /// Which of those in hand a recording is; -1 if a sample of a stretch is missing.
  std::ptrdiff_t take(const Measurements& measured);
  /// What is in the lanes now.
  void load(std::size_t lane, std::size_t recording) {
    of_whole_[lane] = &recorded_[recording].whole;
    of_pieces_[lane] = &recorded_[recording].pieces;
  }
  const LaneStretch::Sums& of_whole() const { return of_whole_; }
  const LaneStretch::Sums& of_pieces() const { return of_pieces_; }

 private:
  struct Recorded {
    StretchSums whole, pieces;
  };
  CompressedTest whole_, pieces_;
  LaneIntervals first_;
  LaneStretchLag lag_;
  LaneStretch piece_;
  std::vector<Recorded> recorded_;
  std::size_t recordings_ = 0;
  LaneStretch::Sums of_whole_{}, of_pieces_{};
};

}  // namespace drift
