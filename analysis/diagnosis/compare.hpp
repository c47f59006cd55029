#pragma once

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/search/refit.hpp"

namespace drift::diagnosis {

/// In-sample comparison of two models on one test; without `patched` the fields "after" repeat
/// "before". Innovations of both are judged under one noise, the second's, which has no misfit in
/// it; so is what the score foretold. Held-out prediction and start spread are filled in elsewhere.
FitComparison compare(const search::Fitted& nominal, const search::Refit* patched,
                      int whiteness_draws);

/// Largest start-consistency ratio over the parameters of fits of one model from several starts (at
/// least two; NaN with less).
double start_spread(const std::vector<BatchResult>& fits);

}  // namespace drift::diagnosis
