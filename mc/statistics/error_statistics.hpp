#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/stats/proportion.hpp"
#include "mc/statistics/distribution_bins.hpp"

namespace drift::mc {

/// A number with an interval around it; NaN ends where there is none.
struct Estimated {
  double value = 0.0, low = 0.0, high = 0.0;
  double half_width() const { return 0.5 * (high - low); }
};

/// Errors of one parameter as estimated by one filter, run by run.
class ErrorStatistics {
 public:
  explicit ErrorStatistics(double prior_sigma) : prior_sigma_(prior_sigma) {}

  /// Takes in an estimate that is `error` off and says `sigma` of itself.
  void add(double error, double sigma);

  std::uint64_t runs() const { return n_; }
  double prior_sigma() const { return prior_sigma_; }
  /// Mean error with its interval, mean +- t SD / sqrt(n), t of Student's distribution: the SD is
  /// that of these runs, too.
  Estimated bias(double confidence = 0.95) const;
  /// Root mean square error. The interval is that of the log of the mean square after Student, with
  /// the scatter of the squares of these runs: squares are skewed, their logs are not. Of normal
  /// errors it holds 91 to 96 % for any number of runs (IntervalsOfFewRuns.*), of a bias that is
  /// large against their spread as many.
  Estimated rmse(double confidence = 0.95) const;
  double mean_sigma() const;  ///< root mean square of the reported sigmas
  /// Root mean square error over root mean square sigma: 1 for an honest filter, large for one that
  /// deceives. The interval: the same, of the squares over the mean square sigma.
  Estimated deception() const;
  /// How many sigmas above chance the errors are larger than sigmas that hold would leave them:
  /// n deception^2 as chi-square of n degrees.
  double sigmas_above() const;
  /// Share of runs whose error is below 1, 2, 3 sigma.
  const std::array<stats::Rate, 3>& coverage() const { return coverage_; }
  /// Where the magnitudes of error over sigma lie in those of a standard normal number.
  const DistributionBins& magnitudes() const { return magnitudes_; }
  double learning() const { return mean_sigma() / prior_sigma_; }

 private:
  double prior_sigma_;
  std::uint64_t n_ = 0;
  // Errors in prior sigmas.
  double sum_ = 0.0, square_ = 0.0, variance_ = 0.0;
  double fourth_ = 0.0, square_variance_ = 0.0, variance_square_ = 0.0;
  std::array<stats::Rate, 3> coverage_{};
  DistributionBins magnitudes_;
};

}  // namespace drift::mc
