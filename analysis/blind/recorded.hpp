#pragma once

#include "analysis/blind/generate.hpp"

namespace drift::blind {

/// Of every trial in a recording at least this part of its rests, one after the other: few trials
/// have the same noise throughout, and what a recording as long can tell is not changed much.
inline constexpr double least_part = 2.0 / 3.0;

/// What each trial in a recording of sensors on a case is to hide (design.hpp): the plan is its
/// name, the equation that of the study's first filter. InputError (config) for strata that cannot
/// be hidden in one.
std::vector<TrialPlan> recorded_trials(const mc::Study& study, const Recording& recording);

/// A trial in a part of a recording: its gyros and accelerometers as they were read, or as they
/// would have been with an effect besides (strapdown::reread), of a size as the projected
/// signature has it under the noise that is found in that part. nominal: the study that the solver
/// gets, read back. A pure function of (study, recording, plan). InputError (config) if nothing can
/// be hidden as asked.
MadeTrial hide_in(const Recording& recording, const mc::Study& study, const mc::Study& nominal,
                  const TrialPlan& plan);

}  // namespace drift::blind
