#pragma once

#include "analysis/search/fitted.hpp"
#include "analysis/search/scores/log_sum.hpp"
#include "analysis/search/settle_noise.hpp"

namespace drift::search {

/// An unknown input in one equation and the white noise that is left beside it.
struct WithInput {
  inference::NoiseEstimate noise;
  double log_evidence = never;  ///< of both
};

/// The likeliest input. It is looked for on the white noise without it, which a large one makes
/// large; beside one of free form the noise is estimated anew, as it is beside all that competes.
WithInput with_input(const Fitted& e, const inference::NoiseEstimate& white, UnknownInputs inputs);

}  // namespace drift::search
