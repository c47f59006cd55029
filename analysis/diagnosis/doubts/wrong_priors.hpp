#pragma once

#include <optional>

#include "analysis/diagnosis/findings/remark.hpp"
#include "analysis/search/detect.hpp"

namespace drift::diagnosis {

/// Nominal parameters that the recording moves further from their priors than any of them would
/// lie with a chance of alpha, were all priors right (Bonferroni): the fit is good, what it says is
/// not to be believed (isotropic D_I, for one, is Earth rate about Up).
std::optional<remark::BeyondPrior> beyond_prior(const FilterSpec& nominal,
                                                const search::Fitted& fit, double alpha);

/// Such parameters without which nothing significant is missing: where their priors are as wide as
/// the data take them from their means.
struct WrongPriors {
  remark::BeyondPrior beyond;  ///< `explains`
  /// Log evidence of the nominal model with those priors, noise as declared or not, and how rare
  /// such priors are: as any number that a study says (SiteLimits::another), one prior is wrong of
  /// 1000, and by as much as it is found to be (as sizes of effects beyond their usual ones are,
  /// inference/size_prior.hpp).
  double log_evidence = 0.0;
};

/// Empty if there are none, or something is missing beside them. fit: of the nominal model, under
/// declared noise.
std::optional<WrongPriors> wrong_priors(const FilterSpec& nominal, const MeasuredTest& test,
                                        const BatchResult& fit,
                                        const search::SearchOptions& options);

}  // namespace drift::diagnosis
