#pragma once

#include <optional>

#include "analysis/diagnosis/findings/proposal.hpp"
#include "analysis/diagnosis/held_out/held_out.hpp"
#include "analysis/search/search.hpp"

namespace drift::proposal {

/// A form for a misfit that nothing known explains. Every form of the grammar (grammar.hpp) is
/// scored by the linearised test; those that are no chance, however many were tried, are put into
/// the library as terms of the study, fitted through the full dynamics and weighed like candidates.
/// The best that leaves nothing significant is proposed if it predicts held-out positions better.
/// noise: under which the misfit is one. Changes the process's own terms while it runs: not while
/// other threads diagnose.
std::optional<diagnosis::Proposal> propose(const search::Search& found,
                                           const inference::NoiseModel& noise,
                                           const MeasuredTest& test, double alpha,
                                           const diagnosis::FoldOptions& folds);

}  // namespace drift::proposal
