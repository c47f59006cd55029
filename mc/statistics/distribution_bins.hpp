#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/stats/proportion.hpp"

namespace drift::mc {

/// Where numbers that should follow a known distribution lie in it: bins of equal probability, each
/// of which holds the same share of them if they do follow it.
class DistributionBins {
 public:
  static constexpr std::size_t size = 20;

  /// probability: of the distribution at or below the number, 0 to 1.
  void add(double probability);

  const std::array<std::uint64_t, size>& counts() const { return counts_; }
  std::uint64_t total() const { return total_; }
  stats::Rate in(std::size_t bin) const { return {counts_[bin], total_}; }
  /// At or below the upper edge of a bin, where (bin + 1) / size of the distribution is.
  stats::Rate up_to(std::size_t bin) const;

 private:
  std::array<std::uint64_t, size> counts_{};
  std::uint64_t total_ = 0;
};

/// Of chi-square of `dof` degrees at or below `value`.
double chi_square_probability(double value, double dof);

/// Of the magnitude of a standard normal number at or below |z|, to the edges of the bins: the
/// middle of the bin.
double magnitude_probability(double z);

/// A rate as it was after more and more trials: 1, 2, ... 10, then in steps of a tenth, so that its
/// length grows with the logarithm of the trials.
class RateCourse {
 public:
  /// After every trial.
  void follow(const stats::Rate& so_far);
  const std::vector<stats::Rate>& steps() const { return steps_; }

 private:
  std::vector<stats::Rate> steps_;
  std::uint64_t next_ = 1;
};

}  // namespace drift::mc
