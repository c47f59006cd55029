#pragma once

#include "analysis/search/search.hpp"

namespace drift::search {

/// Weighs explanations against each other by evidence and prior and moves those up to the credible
/// probability into out.sets, the others into out.rejected. Of several with one name the best
/// stands for all, and what says more is left out where less will do.
///
/// Adequate ones and those whose leftover may be chance compete alike, the latter at the price of
/// that chance: a far better explanation beside which something unrelated is just significant must
/// not lose all to a poor one that happens to cover that too. Nothing is done, and false returned,
/// if none is adequate (chance_alone: none tolerable) or if something unknown in one equation
/// explains the test far better than the best of them.
bool weigh(const Examination& e, std::vector<Refit>& refits, bool chance_alone,
           const SearchOptions& options, Search& out);

}  // namespace drift::search
