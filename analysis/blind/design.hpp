#pragma once

#include "analysis/blind/trial.hpp"
#include "mc/study/blind_spec.hpp"

namespace drift::blind {

/// What each trial of a blind study is to hide. Strata have the shares that are asked for (largest
/// remainders); plans, modes, couplings and sizes are spread evenly within each stratum and mixed
/// at random, and so is the order of the trials: their number says nothing. A pure function of
/// (spec, seed).
std::vector<TrialPlan> design_trials(const mc::BlindSpec& spec, std::uint64_t seed);

}  // namespace drift::blind
