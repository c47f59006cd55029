#pragma once

#include "core/config/section.hpp"
#include "mc/study/blind_spec.hpp"

namespace drift::mc {

/// Reads [blind]:
///
///   [blind]
///   trials = 300                       # recordings
///   plans = ["twelve", "slew12"]       # presets; dwell, sample and entry come from [plan]
///   modes = ["free", "level"]
///   couplings = ["eq5", "eq6", "servo"]    # of the truth; the nominal filter has the same one,
///   eq6 for servo sizes = [4, 6, 8, 12]              # or { uniform = [3, 14] }: what the fit
///   cannot absorb [sigma] pair_size = 10 pair_cosine = 0.7 outside_size = 15 most_prior_sigmas = 3
///   [blind.shares]                     # weights
///   null = 20
///   wrong_noise = 15
///   single = 40
///   pair = 10
///   outside = 8
///   local = 7
///   [blind.further]                    # trials beside the others, by number
///   other_equation = 20
///   noisy_single = 40
///   noisy_covariate = 20
BlindSpec read_blind(config::Section section);

}  // namespace drift::mc
