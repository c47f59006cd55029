#pragma once

#include <vector>

#include "analysis/diagnosis/findings/where.hpp"
#include "analysis/diagnosis/judge.hpp"
#include "analysis/diagnosis/recovered.hpp"

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

/// Where it is by the best explanation there is, else by the strongest window; what it looks like
/// with everything in it that the nominal model leaves.
Located located(const search::Fitted& nominal, const search::Search& found, const Judged& judged,
                const Timeline& timeline, const std::vector<preparation::Covariate>& covariates,
                Signals signals);

}  // namespace drift::diagnosis
