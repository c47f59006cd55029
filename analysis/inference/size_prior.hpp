#pragma once

#include <limits>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::inference {

/// How large an effect may be is known to orders of magnitude only: physics.md section 4 gives
/// ranges of one to two decades. So a candidate's amplitudes have, with equal chances, a prior of
/// 1, 0.3, 0.1, 0.03 or 0.01 of the library's sigma, all amplitudes of one cause alike (a scale
/// mixture). With the library's sigma alone, of two effects that explain a test equally well the
/// one that the test sees worse would always win, only because its estimate is less sharp.
///
/// A library may be wrong about a size. That an amplitude lies FitLimits::beyond_prior sigmas off
/// or more has the chance that a normal prior gives it, and as little is known there of its size:
/// of w sigmas or more that chance times (beyond_prior / w)^2. Each such amplitude pays this share
/// and has a prior of w sigmas, so that nothing holds it back.
double share_of_sizes(double w);

/// An amplitude as the data alone have it, of one that a fit with prior and sigma holds back.
struct DataAlone {
  double off;     ///< from the mean of the prior, in the unit of what was given
  double sigmas;  ///< the same over what prior and data let expect, sqrt(prior^2 + data's sigma^2)
};
/// off: of the fit, from the mean of the prior; sigma of the fit, smaller than the prior's. The
/// data's information is 1/sigma^2 - 1/prior^2; whatever the other parameters are, a fit lies
/// sqrt(prior^2 - sigma^2) from the mean where the prior is right.
DataAlone without_prior(double off, double sigma, double prior_sigma);

/// Log evidence of amplitudes with projected information C and gradient g (in prior sigmas) against
/// none: log of the mean over scales s of exp(g' (1/s^2 + C)^-1 g / 2) / sqrt(det(1 + s^2 C)), and
/// of amplitudes as found where a prior of one sigma does not explain them.
double log_evidence_of_sizes(const MatX& C, const VecX& g);

/// The same of those scales alone at which an effect of one of their sigmas is
/// VisibleLimits::size strong; the rest would leave a test as it is without the effect.
struct VisibleEvidence {
  double log = -std::numeric_limits<double>::infinity();  ///< of the mean over them
  double share = 0.0;                                     ///< of all scales
};
VisibleEvidence evidence_of_visible_sizes(const MatX& C, const VecX& g);

/// Log evidence, against none, of something that no library has and that is found sqrt(T) sigmas
/// strong: from what the test could see (VisibleLimits::size) two decades up, as the library's
/// sizes, every order of magnitude alike, either sign of one amplitude, any phase of two. Of
/// int exp(a z - a^2 / 2) da / (2 a log 100), of two int I_0(a z) exp(-a^2 / 2) da / (a log 100),
/// with the factors in a that vary slowly taken where the integrand is.
double log_evidence_of_unknown_size(double T, int amplitudes = 1);

/// What the mixture changes in the log evidence of a fit: amplitudes x with posterior `covariance`
/// (in sigmas of the priors that it was made with). cause: which cause each amplitude belongs to,
/// numbered from 0; causes have scales of their own. wide: by what factor the prior of each is
/// wider than the library's; beyond FitLimits::beyond_prior its size is as found. Empty: none is
/// wider.
double log_gain_of_sizes(const VecX& x, const MatX& covariance, const std::vector<int>& cause,
                         const std::vector<double>& wide = {});

/// The same of amplitudes of one cause that may have been made as small as one could: the scales
/// go on by half decades, each with the chance of any other, to one that the test does not see,
/// a third of its sharpest posterior sigma.
double log_gain_of_sizes_made_small(const VecX& x, const MatX& covariance);

}  // namespace drift::inference
