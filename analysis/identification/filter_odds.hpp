#pragma once

#include <optional>
#include <vector>

#include "analysis/identification/identify.hpp"

namespace drift::identification {

/// Log evidence of every filter, in the order of the summaries, but for a constant that all share:
/// of a Gaussian about its counted batch fit, -cost/2 + log(det P)/2 with P the covariance in units
/// of the priors; the size of the misalignments, which one drift equation shows and the other
/// hides, known to orders of magnitude only (misalignments.hpp). Nothing of a fit that did not
/// converge, where the EKF counts (judged()), with outliers, whose cost is of another kind, and of
/// filters that cannot be compared with the first that has one: another count of scalars, another
/// noise, attitudes known otherwise. Nothing of any where each start has a test of its own.
std::vector<std::optional<double>> log_evidences(const mc::Study& study, const Identification& id);

/// The filters that one test tells from others that may be believed as well.
struct Favoured {
  std::vector<std::size_t> filters, others;  ///< indices in the study, the most probable first
  double log_odds = 0.0;  ///< of these together against the others, each as likely before
};
/// Of filters by their index in `id.summaries` the fewest that are together more probable than
/// SearchLimits::credible, where all were as likely before the test. Nothing if that takes all, or
/// if one has no evidence.
std::optional<Favoured> favoured(const mc::Study& study, const Identification& id,
                                 const std::vector<std::size_t>& summaries);

}  // namespace drift::identification
