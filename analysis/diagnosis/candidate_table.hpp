#pragma once

#include <vector>

#include "analysis/search/cause.hpp"
#include "analysis/search/search.hpp"

namespace drift::diagnosis {

/// The table of every candidate that was tried, the most convincing first. Scores are those of the
/// linearised test; frame_closure is scored by the jump to the other equation, which its linear
/// score at the nominal fit need not see; where explanations were refitted, their probabilities
/// take the place of those of the linear scores.
std::vector<search::CandidateScore> candidate_table(const search::Fitted& nominal,
                                                    const search::Search& found);

}  // namespace drift::diagnosis
