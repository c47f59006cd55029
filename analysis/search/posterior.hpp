#pragma once

#include <vector>

#include "analysis/search/search.hpp"

namespace drift::search {

/// Probabilities of what a recording may be, summing to 1. A model is what drives the mean (nothing
/// beside the nominal model; causes of the library; something outside it) and the noise (as
/// declared or not). Means and noise have the prior of PosteriorPrior, over effects that the test
/// could see: their sizes are known to orders of magnitude (size_prior.hpp), of which those count
/// that would be VisibleLimits::size strong; settings share a term's prior, a noise that was
/// estimated has the prior of inference::NoisePrior.
struct Posterior {
  /// Nothing missing that the test could see (VisibleLimits::size), noise as declared.
  double consistent = 1.0;
  double noise_only = 0.0;  ///< nothing missing, noise not as declared
  double outside = 0.0;     ///< something that no term of the library describes
  /// Nothing missing, but priors of the nominal model wrong; 0 where none was asked about.
  double wrong_priors = 0.0;
  /// The other way round about the priors of the nominal model: all right where this is of wrong
  /// ones, and else wrong ones with something missing besides. 0 where that was not asked about.
  double other_priors = 0.0;
  /// Explanations by the library, most probable first; what is below a thousandth is shared out
  /// over all.
  struct Explained {
    Explanation choices;
    double probability = 0.0;
  };
  std::vector<Explained> named;
};

/// Logs of what each says of the data, before the prior over the three.
struct Evidence {
  /// Nothing missing, by noise; the noise's prior is in them.
  double declared = 0.0, estimated = 0.0;
  double outside = 0.0;
  /// Explanations by the library, their prior among themselves included.
  struct Weighed {
    Explanation choices;
    double log_weight = 0.0;
  };
  std::vector<Weighed> library;
  double wrong_priors = never;  ///< nothing missing, how rare such priors are included
  double other_priors = never;  ///< Posterior::other_priors, the prior over the three included
};
Posterior posterior_of(const Evidence& evidence);
/// Of all that an evidence lists, together.
double log_total(const Evidence& evidence);

/// Of a search that found nothing significant: by the linearised scores of single candidates;
/// otherwise of the explanations that were fitted. Nothing of wrong priors.
Evidence evidence_of(const Search& found);
inline Posterior posterior_of(const Search& found) {
  return posterior_of(evidence_of(found));
}

}  // namespace drift::search
