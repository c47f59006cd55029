#pragma once

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/chance_thresholds.hpp"
#include "analysis/search/other_equation.hpp"

namespace drift::search {

/// How sure a diagnosis must be.
struct SearchOptions {
  double alpha =
      inference::SearchLimits::alpha;  ///< chance of a false alarm over everything that is tried
  double credible =
      inference::SearchLimits::credible;  ///< probability that the listed causes must hold together
  int draws = 4000;                       ///< of the null distribution
  std::size_t most_refits = inference::EffortLimits::refits;
  /// Covariates whose values were read off the recording itself, and the log of how probable they
  /// were before: whatever follows them has that prior besides.
  struct ReadOff {
    CovariateSet covariates = 0;
    double log_prior = 0.0;
  } read_off;
};

/// Whether there is anything that the nominal model leaves out.
struct Detection {
  Fitted nominal;  ///< its noise settled (settle_noise.hpp)
  /// The noise that the nominal model needs without what took its place; where something did.
  std::optional<inference::NoiseEstimate> noise_alone;
  ChanceThresholds thresholds;
  inference::MaxNull pairs;
  double p_library = 1.0, p_scan = 1.0, p_pairs = 1.0, p_lone = 1.0, p_periodic = 1.0;
  std::optional<OtherEquation> other;  ///< in the place of the nominal one
  double other_equation = 0.0;         ///< its gain; -infinity where there is none
  double p_value = 1.0;                ///< of the strongest family, for all families together
  bool significant = false;
};

Detection detect(Fitted nominal, const MeasuredTest& test, const SearchOptions& options);

}  // namespace drift::search
