#pragma once

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/diagnosis/recovered.hpp"
#include "analysis/search/chance_thresholds.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::diagnosis {

/// Where the misfit sits. signature: the whitened, cleaned columns' best combination (what explains
/// the misfit), one value per row; its product with the residual, row by row, is shared out between
/// channels and positions. Windows: those significant at threshold, overlapping ones once.
Where locate(const search::Fitted& e, const search::ChanceThresholds& thresholds,
             const VecX& signature, std::size_t most_windows);

/// Whitened residual signature of candidate columns at given amplitudes (prior sigmas).
VecX signature_of(const inference::Projector& projector,
                  const std::vector<std::pair<int, double>>& cause);

/// The same of a window's box at the amplitude that fits best.
VecX signature_of(const inference::MeasuredRows& rows, const Timeline& timeline,
                  const inference::Projector& projector, const inference::Window& window);

/// The strongest window of all; null if nothing was scanned.
const inference::Window* strongest_window(const search::Fitted& e);

}  // namespace drift::diagnosis
