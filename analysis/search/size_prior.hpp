#pragma once

#include <limits>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::search {

/// How large an effect may be is known to orders of magnitude only: physics.md section 4 gives
/// ranges of one to two decades. So a candidate's amplitudes have, with equal chances, a prior of
/// 1, 0.3, 0.1, 0.03 or 0.01 of the library's sigma, all amplitudes of one cause alike (a scale
/// mixture). With the library's sigma alone, of two effects that explain a test equally well the
/// one that the test sees worse would always win, only because its estimate is less sharp.

/// Log evidence of amplitudes with projected information C and gradient g (in prior sigmas) against
/// none: log of the mean over scales s of exp(g' (1/s^2 + C)^-1 g / 2) / sqrt(det(1 + s^2 C)).
double log_evidence_of_sizes(const MatX& C, const VecX& g);

/// The same of those scales alone at which an effect of one of their sigmas is
/// VisibleLimits::size strong; the rest would leave a test as it is without the effect.
struct VisibleEvidence {
  double log = -std::numeric_limits<double>::infinity();  ///< of the mean over them
  double share = 0.0;                                     ///< of all scales
};
VisibleEvidence evidence_of_visible_sizes(const MatX& C, const VecX& g);

/// What the mixture changes in the log evidence of a fit that was made with unit priors: amplitudes
/// x with posterior `covariance` (in prior sigmas). cause: which cause each amplitude belongs to,
/// numbered from 0; causes have scales of their own.
double log_gain_of_sizes(const VecX& x, const MatX& covariance, const std::vector<int>& cause);

}  // namespace drift::search
