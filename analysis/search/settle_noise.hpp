#pragma once

#include <optional>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::search {

/// What takes the place of noise that drives the platform.
struct NoiseSettled {
  inference::NoiseEstimate noise;  ///< what is left of it
  double probability = 0.0;        ///< that it is not such noise alone
};

/// Inputs in one equation that compete with noise. Beside a cause what is periodic is told with it,
/// and may stay in the noise.
enum class UnknownInputs { free_form, periodic_too };

/// Where noise that drives the platform seemed necessary, effects may have been taken for it. Both
/// are models of one test and compete by their evidence: candidates in the mean (sizes and settings
/// integrated over, as the library offers them), noise of any kind beside them (NoiseEstimate::
/// log_evidence), an unknown input in one equation. Models are searched from two beginnings -
/// nothing in the mean and all noise that is needed, and white noise with candidates added one
/// after the other - by adding, dropping and swapping one candidate as long as that gains; the
/// noise is estimated anew in each that may be the best of its step.
/// Returns what to put in the place of e.noise, or nothing if what is in its place is not credible:
/// the noise alone has SearchLimits::credible of the probability. tries: candidates fitted at each
/// step.
std::optional<NoiseSettled> settle_noise(const Fitted& e,
                                         std::size_t tries = inference::EffortLimits::noise_tries,
                                         UnknownInputs inputs = UnknownInputs::periodic_too);

/// The noise with a drift in it that each caging draws anew, where it alone has credible odds
/// against all models without it, effects and unknown inputs included.
std::optional<inference::NoiseEstimate> drift_of_cagings(const Fitted& e);

}  // namespace drift::search
