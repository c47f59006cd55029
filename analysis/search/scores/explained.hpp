#pragma once

#include "analysis/inference/signatures.hpp"

namespace drift::search {

/// What a better model takes out of the data as the nominal one sees them, rows of `problem`: the
/// residuals that go away, and what the nominal parameters, which had been pulled away, no longer
/// have to say. Without the second part a cause that they had taken up against their priors would
/// seem to explain nothing. problem: linearised about the fit `before` of the nominal filter;
/// `after`: of a filter that holds it.
VecX taken_out(const inference::LinearProblem& problem, const FilterSpec& nominal,
               const BatchResult& before, const FilterSpec& better, const BatchResult& after);

}  // namespace drift::search
