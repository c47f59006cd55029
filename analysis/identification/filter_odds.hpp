#pragma once

#include <optional>
#include <vector>

#include "analysis/identification/identify.hpp"

namespace drift::identification {

/// Log evidence of a filter, but for a constant that all filters of one test share: of a Gaussian
/// about its counted batch fit, -cost/2 + log(det P)/2 with P the covariance in units of the
/// priors; the size of the misalignments, which one drift equation shows and the other hides, known
/// to orders of magnitude only (misalignments.hpp). Of filters that believe the same of the noise.
/// Nothing of a fit that did not converge, where the EKF counts (judged()), or with outliers, whose
/// cost is of another kind.
std::optional<double> log_evidence(const mc::Study& study, const Identification& id,
                                   const FilterSummary& filter);

/// The filter that one test tells from all others that may be believed as well.
struct FavouredFilter {
  std::size_t filter = 0;           ///< index in the study
  double log_odds = 0.0;            ///< against all others together, each as likely before
  std::vector<std::size_t> others;  ///< indices in the study
};
/// Of filters by their index in `id.summaries`, two and more, the one whose probability is more
/// than SearchLimits::credible where all were as likely before the test. Nothing if none is, or if
/// they cannot be compared: the test of each start its own, other scalars or noise, no evidence.
std::optional<FavouredFilter> favoured(const mc::Study& study, const Identification& id,
                                       const std::vector<std::size_t>& summaries);

}  // namespace drift::identification
