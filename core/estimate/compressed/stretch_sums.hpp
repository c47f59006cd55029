#pragma once

#include <array>
#include <vector>

#include "core/estimate/compressed/compressed_dwells.hpp"

namespace drift {

/// What a recording says of the stretches of a test (CompressedTest), for who has several
/// recordings in hand: projections of its readings, and of what no polynomial reaches no more than
/// its cost and its products need.
class StretchSums {
 public:
  struct Axis {
    double reference = 0.0;  ///< what readings count from [unit]
    VecX measured;           ///< projections, whitened
    VecX beside;             ///< sum of basis_k left_{k+1} + basis_{k+1} left_k over the samples
  };
  using Channel = std::array<Axis, 3>;

  /// False, and of no use, where a sample of a stretch is missing. Allocates nothing from the
  /// second time on.
  bool take(CompressedTest& test, const Measurements& measured);

  /// Of interval i, which is a stretch. what: means of accelerometers, or gimbals at the end.
  const Channel& of(std::size_t i, Reading what) const { return channels_[i][index(what)]; }
  double left_over() const { return left_over_; }  ///< sum of left_k^2
  double lagged() const { return lagged_; }        ///< sum of left_k left_{k+1}

 private:
  static std::size_t index(Reading what) { return what == Reading::mean ? 0 : 1; }
  bool take_channel(const StretchChannel& from, std::size_t samples, Channel& to);

  std::vector<std::array<Channel, 2>> channels_;  ///< by interval
  double left_over_ = 0.0, lagged_ = 0.0;
};

}  // namespace drift
