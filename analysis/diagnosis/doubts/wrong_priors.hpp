#pragma once

#include <optional>

#include "analysis/diagnosis/findings/remark.hpp"
#include "analysis/search/posterior.hpp"

namespace drift::diagnosis {

/// Nominal parameters that the recording moves further from their priors than any of them would
/// lie with a chance of alpha, were all priors right (Bonferroni): the fit is good, what it says is
/// not to be believed (isotropic D_I, for one, is Earth rate about Up).
std::optional<remark::BeyondPrior> beyond_prior(const FilterSpec& nominal,
                                                const search::Fitted& fit, double alpha);

/// Priors of such parameters that are wrong instead: the nominal model with priors as wide as the
/// data take these from their means, and what is missing from that.
struct WrongPriors {
  remark::BeyondPrior beyond;  ///< `explains` where nothing is
  FilterSpec filter;           ///< the nominal model with such priors
  search::Search found;
  /// With how rare such priors are: as any number that a study says (SiteLimits::another), one
  /// prior is wrong of 1000, and by as much as it is found to be (as sizes of effects beyond their
  /// usual ones are, inference/size_prior.hpp).
  search::Evidence evidence;
};

/// Empty if there are none, or they are far less probable than one effect where priors are right.
/// Where an effect is missing besides, those are wide that it does not take back. right: what was
/// found with the priors of the study. fit: of the nominal model, under declared noise.
std::optional<WrongPriors> wrong_priors(const FilterSpec& nominal, const MeasuredTest& test,
                                        const BatchResult& fit, const search::Search& right,
                                        double log_total_of_right,
                                        const search::SearchOptions& options);

}  // namespace drift::diagnosis
