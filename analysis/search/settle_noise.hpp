#pragma once

#include <optional>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::search {

/// Where noise that drives the platform seemed necessary, an effect may have been taken for it. Two
/// things speak against noise, and then it is estimated again without what was no noise:
/// - an input in one equation alone does better than such noise would let it (noise_doubt.hpp):
///   what is noise, all three instruments have;
/// - a candidate in the mean does, or it is significant by the likelihood ratio with the noise at
///   its best in both. All candidates are asked under several noises, the best `tries` of them with
///   the noise estimated anew.
/// threshold: strength that makes a candidate significant. rounds: candidates that may be in the
/// mean together. Returns the noise to put in the place of e.noise; nothing if that is believed.
std::optional<inference::NoiseEstimate> settle_noise(
    const Fitted& e, double threshold, std::size_t tries = inference::EffortLimits::noise_tries,
    int rounds = inference::EffortLimits::noise_rounds);

}  // namespace drift::search
