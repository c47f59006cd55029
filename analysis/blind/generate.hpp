#pragma once

#include "analysis/blind/trial.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::blind {

/// Stream of the draws of a trial; the design uses the first few.
inline constexpr std::uint32_t choice_stream = 64;

/// A recording and what it hides.
struct MadeTrial {
  Recording recording;
  KeyEntry key;
};

/// Makes a trial. nominal: the study that the solver gets, read back. The truth is integrated by
/// CVODE (with the servo's 12 states where asked for); parameters and attitudes are drawn from
/// [truth]; the effect is as strong as its wanted size asks, and another one is taken where that
/// would be implausible. A pure function of (study, plan). InputError (config) if nothing can be
/// hidden as asked, or as mc::require_own_terms() of either study.
MadeTrial make_trial(const mc::Study& study, const mc::Study& nominal, const TrialPlan& plan);

}  // namespace drift::blind
