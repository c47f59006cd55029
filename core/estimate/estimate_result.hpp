#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/estimate/layout.hpp"

namespace drift {

/// What an estimator says of one parameter, SI.
struct ParameterEstimate {
  std::size_t param = 0;  ///< index in TermLibrary
  double start = 0.0;     ///< where the estimate started
  double value = 0.0;
  double sigma = 0.0;
  double prior_mean = 0.0;
  double prior_sigma = 0.0;
  /// Posterior over prior sigma: 1 = nothing learned, 0 = known.
  double learning_ratio() const { return sigma / prior_sigma; }
};

/// Why an estimate ended.
enum class EstimateStatus { ok, not_converged, diverged };

/// Result of an estimator on one recording from one start.
struct EstimateResult {
  EstimateStatus status = EstimateStatus::ok;
  std::string cause;                          ///< empty if ok
  std::vector<ParameterEstimate> parameters;  ///< in the order of the layout
  MatX covariance;           ///< of the parameters divided by their prior sigma, layout order
  double statistic = 0.0;    ///< EKF: sum of NIS; batch: minimum of data + prior cost
  std::size_t measured = 0;  ///< scalars used; `statistic` is chi-square of as many degrees when
                             ///< model, noise and priors are right
  int iterations = 0;        ///< batch alone
  /// Where lambda was integrated over (over_closure()): log of the integral of exp(-cost / 2) times
  /// the root of the determinant of the others' covariance, in prior sigmas, over its prior. NaN
  /// where it was not: then that is -statistic / 2 + log det(covariance) / 2.
  double log_evidence = std::numeric_limits<double>::quiet_NaN();
  /// The noise of some readings is an upper bound (Readout): `statistic` may be far less.
  bool noise_at_most = false;

  double statistic_per_dof() const { return statistic / static_cast<double>(measured); }
  const ParameterEstimate* find(std::size_t param) const {
    for (const auto& p : parameters)
      if (p.param == param) return &p;
    return nullptr;
  }
};

/// Parameters of a result from scaled deviations and their scaled covariance.
inline std::vector<ParameterEstimate> parameter_estimates(const Layout& layout, const VecX& start,
                                                          const VecX& x, const MatX& P) {
  std::vector<ParameterEstimate> all;
  for (std::size_t k = 0; k < layout.size(); ++k) {
    const double s = layout.sigma[k], m = layout.mean[k];
    all.push_back({layout.params[k], m + s * start[k], m + s * x[k], s * std::sqrt(P(k, k)), m, s});
  }
  return all;
}

}  // namespace drift
