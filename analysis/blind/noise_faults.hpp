#pragma once

#include <cstdint>
#include <span>

#include "analysis/blind/world.hpp"
#include "core/base/rng.hpp"
#include "core/params/covariates.hpp"

namespace drift::blind {

inline constexpr std::size_t num_noise_faults = 7;

/// Makes the noise of a world other than declared, without any further physics, and says how:
///
///   noise_scale          all sensors 0.75 to 1.6 times as noisy as declared
///   angle_random_walk    3e-4 to 3e-3 deg/sqrt(h)
///   drift_random_walk    1e-3 to 5e-3 deg/h/sqrt(h)
///   markov_drift         2e-3 to 1e-2 deg/h, correlated over 10 to 60 min
///   coloured_accelerometer   0.5 to 1.5 declared sigmas, correlated over 3 to 15 min
///   caging_drift         3e-3 to 3e-2 deg/h, another drift after each caging; without three
///   cagings
///                        markov_drift
///   outliers             0.1 to 1 % of the samples wrong by 10 sigma
///
/// Sizes: physics.md 4, entries 8 to 11, 50, and 3.4.
HiddenEffect spoil_noise(std::size_t kind, World& world, Stream& stream);

/// The timeline as it is recorded with covariates that have noise of their own, white from row to
/// row: 0.1 to 0.5 of what a number varies by (rms), 1 to 5 % of a vector. A function of the seed,
/// the trial and the covariate: what other covariates there are changes nothing.
Timeline with_noisy_covariates(Timeline timeline, std::uint64_t seed, std::uint64_t trial,
                               std::span<const CovariateSpec> covariates = known_covariates);

}  // namespace drift::blind
