#pragma once

#include <vector>

#include "analysis/diagnosis/findings/proposal.hpp"
#include "analysis/diagnosis/findings/where.hpp"
#include "analysis/diagnosis/judge.hpp"
#include "analysis/diagnosis/recovered.hpp"
#include "analysis/search/cause.hpp"

namespace drift::diagnosis {

/// Where the misfit is, and what the missing input looks like.
struct Located {
  Where where;
  std::vector<RecoveredSignal> signals;  ///< strongest first; none where nothing is missing
};

/// Whether the missing input is recovered as a time series.
enum class Signals { recovered, left_out };

/// The noise under which what is missing is a signal: noise that was needed only because of the
/// effect would take it away.
inference::NoiseModel noise_without_effect(const search::Fitted& nominal,
                                           const search::Search& found);

/// Of causes that are named everything follows from them: equation, channels, positions, when they
/// act, and the input that is recovered. Without a name the equation is that of the input of free
/// form with the largest evidence, the rest of the best explanation there is, else of the strongest
/// window; the signals hold everything that the nominal model leaves.
Located located(const search::Fitted& nominal, const search::Search& found, const Judged& judged,
                const std::vector<search::Cause>& causes, const Timeline& timeline,
                const std::vector<preparation::Covariate>& covariates, Signals signals);

/// Where no known effect explains it and a form does, the misfit is where the form acts.
void move_to(Located& place, const Proposal& form);

}  // namespace drift::diagnosis
