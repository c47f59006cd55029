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

/// Weights of a run in the replicates of a Poisson bootstrap: how often each replicate drew the
/// run.
///
/// Poisson(1) numbers keyed by the run number, so replicates need neither the number of runs nor
/// the runs before: one pass, bounded memory, the same result in any order of computation (Chamandy
/// et al. 2012, Google, "Estimating uncertainty for massive data streams").
class BootstrapWeights {
 public:
  explicit BootstrapWeights(std::uint64_t seed, std::size_t replicates)
      : seed_(seed), weights_(replicates) {}
  /// The weights of a run, one per replicate.
  std::span<const double> of(std::uint64_t run);
  std::size_t replicates() const { return weights_.size(); }

 private:
  std::uint64_t seed_;
  std::vector<double> weights_;
};

/// Errors of one parameter as estimated by one filter, run by run.
class ErrorStatistics {
 public:
  explicit ErrorStatistics(double prior_sigma, std::size_t replicates);

  /// Takes in an estimate that is `error` off and says `sigma` of itself. weights: of its run.
  void add(double error, double sigma, std::span<const double> weights);

  std::uint64_t runs() const { return n_; }
  double prior_sigma() const { return prior_sigma_; }
  /// Mean error with its interval, mean +- t SD / sqrt(n), t of Student's distribution: the SD is
  /// that of these runs, too.
  Estimated bias(double confidence = 0.95) const;
  /// Root mean square error. The interval: the 2.5 and 97.5 % points of the bootstrap.
  Estimated rmse() const;
  /// The same with a normal interval from the spread of the squared errors (delta method): for
  /// deciding when to stop.
  Estimated rmse_normal(double z) const;
  double mean_sigma() const;  ///< root mean square of the reported sigmas
  /// Root mean square error over root mean square sigma: 1 for an honest filter, large for one that
  /// deceives.
  Estimated deception() const;
  /// Share of runs whose error is below 1, 2, 3 sigma.
  const std::array<stats::Rate, 3>& coverage() const { return coverage_; }
  /// Where the magnitudes of error over sigma lie in those of a standard normal number.
  const DistributionBins& magnitudes() const { return magnitudes_; }
  double learning() const { return mean_sigma() / prior_sigma_; }

 private:
  template <class Ratio>
  Estimated between_replicates(double value, Ratio&& ratio) const;

  double prior_sigma_;
  std::uint64_t n_ = 0;
  // Errors in prior sigmas.
  double sum_ = 0.0, square_ = 0.0, fourth_ = 0.0, variance_ = 0.0;
  std::array<stats::Rate, 3> coverage_{};
  DistributionBins magnitudes_;
  struct Replicate {
    double weight = 0.0, square = 0.0, variance = 0.0;
  };
  std::vector<Replicate> replicates_;
};

}  // namespace drift::mc
