#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/named.hpp"
#include "core/config/section.hpp"

namespace drift::mc {

/// How the truth parameters of the runs are spread over their distributions.
enum class DesignKind {
  random,           ///< independent draws
  latin_hypercube,  ///< every parameter hits each of `runs` equally likely strata once
  sobol,            ///< Sobol sequence with a digital shift
};

/// What makes an estimate of a recording in a study.
enum class EstimatorKind {
  ekf,
  iterated,  ///< the EKF, then once more about what it found
  batch,     ///< Levenberg-Marquardt until it stands still
};

/// As a study file has them.
inline constexpr Named<EstimatorKind> estimators[] = {{"ekf", EstimatorKind::ekf},
                                                      {"iterated", EstimatorKind::iterated},
                                                      {"batch", EstimatorKind::batch}};
constexpr std::string_view key_of(EstimatorKind estimator) {
  return name_in(estimators, estimator);
}

/// When a study point has enough runs: [monte_carlo] stop. With design random alone: the interval
/// supposes independent runs, and the first runs of a Latin hypercube are not stratified.
struct StopSpec {
  std::string quantity;      ///< "silent_failure_rate" or "rmse.KEY"
  double half_width = 0.01;  ///< of a rate, or of an RMSE in prior sigmas
  double confidence = 0.95;
};

/// [monte_carlo] of a study file.
struct MonteCarlo {
  std::uint64_t runs = 100;  ///< with `stop`: at most
  std::uint64_t seed = 1;
  std::uint64_t allowed_failures = 0;
  DesignKind design = DesignKind::random;
  EstimatorKind estimator = EstimatorKind::ekf;
  double healthy_sigma = 0.5;  ///< a sigma below this share of its prior is a claim to know
  std::optional<StopSpec> stop;
};

/// Reads [monte_carlo].
MonteCarlo read_monte_carlo(config::Section section);

}  // namespace drift::mc
