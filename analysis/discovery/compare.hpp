#pragma once

#include "analysis/discovery/diagnosis.hpp"
#include "analysis/discovery/refit.hpp"

namespace drift::discovery {

/// In-sample comparison of two models on one test; without `patched` the fields "after" repeat "before".
/// Held-out prediction and start spread are filled in elsewhere.
FitComparison compare(const Examination& nominal, const Refit* patched);

/// Largest start-consistency ratio over the parameters, fitted from each start (at least two).
double start_spread(const FilterSpec& filter, const Test& test, const std::vector<Theta>& starts);

/// p-value of the Ljung-Box test of whitened residuals, `lags` lags, per channel and chain, the
/// smallest times their number. Only as good as the chi-square it is compared with: short records make
/// it optimistic (discovery.md 4.7).
double ljung_box_p(const LinearProblem& problem, const VecX& whitened, int lags);

}  // namespace drift::discovery
