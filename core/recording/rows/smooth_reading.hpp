#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift {

/// What a readout in steps (reading_step()) shows of something that moves smoothly: the parabolas
/// through what was read around an instant. Row by row such a readout stands still or jumps, which
/// as a rate is all noise.
///
/// The parabolas are nearly as wide as leaves the least error expected (Mallows' C_p): the mean
/// square of what they leave of the readings, and twice the variance of one, step^2 / 12 or more
/// where neighbours scatter by more, for each reading's own part in its parabola. Readings that are
/// one value share one error, so that part is as many times as large, one at most. As read, it is
/// twice the variance: where no parabola is better, as of what jumps, there is none. Somewhat
/// narrower than that, the bias of all of them stays small against the noise of their mean.
class SmoothReading {
 public:
  /// Of a column of a recording with times; empty where it is absent or not read in steps, where
  /// its readings lie on straight lines, or where they are best as they are.
  static std::optional<SmoothReading> of(const Recording& recording, std::string_view column);

  /// At an instant [s]; empty where too little was read around it.
  std::optional<double> at(double t) const;
  double half() const { return half_; }  ///< of the width of the parabolas [s]
  /// Whether that reaches over the whole recording from anywhere in it: the parabolas are one.
  bool is_one_parabola() const { return half_ >= times_.back() - times_.front(); }
  double step() const { return step_; }  ///< of the readout, in internal units

 private:
  SmoothReading() = default;

  std::vector<double> times_, values_;  ///< of the readings; of a long log, means of a few
  double half_ = 0.0, step_ = 0.0;
};

}  // namespace drift
