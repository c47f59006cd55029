#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "analysis/blind/world.hpp"
#include "core/base/rng.hpp"
#include "core/params/covariates.hpp"

namespace drift::blind {

/// Makes the noise of a world other than declared, without any further physics, and says how: in
/// the kind whose turn it is. Without three cagings none differs from the others in its drift: it
/// is correlated then.
HiddenEffect spoil_noise(std::size_t turn, World& world, Stream& stream);

/// The turn of a kind, "caging_drift".
std::size_t noise_fault(std::string_view term);

/// The timeline as it is recorded with covariates that have noise of their own, white from row to
/// row: 0.1 to 0.5 of what a number varies by (rms), 1 to 5 % of a vector. A function of the seed,
/// the trial and the covariate: what other covariates there are changes nothing.
Timeline with_noisy_covariates(Timeline timeline, std::uint64_t seed, std::uint64_t trial,
                               std::span<const CovariateSpec> covariates = known_covariates);

}  // namespace drift::blind
