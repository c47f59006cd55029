#pragma once

#include <span>
#include <vector>

#include "analysis/identification/spikes.hpp"
#include "analysis/inference/signatures.hpp"
#include "core/estimate/batch.hpp"

namespace drift::diagnosis {

/// The nominal model fitted to a test, from every start; the best is kept.
struct NominalFit {
  Measurements measured;                      ///< without isolated gross samples
  std::vector<identification::Spike> spikes;  ///< those samples
  BatchResult fit;
  double start_spread = 0.0;  ///< largest start-consistency ratio; NaN with one start
};

/// starts: initial estimates beside the prior means.
NominalFit fit_nominal(const FilterSpec& nominal, const MeasuredTest& given,
                       std::span<const Theta> starts);

/// A filter that holds causes beside the nominal parameters, fitted from starts of the latter.
/// Parameters of a cause are held at `found` until the others have been fitted (with them they may
/// make a narrow bent valley), then all are free.
std::vector<BatchResult> fit_from_starts(const FilterSpec& nominal, const FilterSpec& filter,
                                         const MeasuredTest& test, std::span<const Theta> starts,
                                         const Theta& found);

}  // namespace drift::diagnosis
