#pragma once

#include <optional>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/diagnosis/recovered.hpp"
#include "analysis/search/chance_thresholds.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::diagnosis {

/// Where the misfit sits. signature: the whitened, cleaned columns' best combination (what explains
/// the misfit), one value per row; its product with the residual, row by row, is shared out between
/// channels and positions. Nothing where nothing explains it: then that is what chi-square is above
/// its rows. Windows: those significant at threshold, overlapping ones once.
Where locate(const search::Fitted& e, const search::ChanceThresholds& thresholds,
             const std::optional<VecX>& signature, std::size_t most_windows);

/// Whitened residual signature of candidate columns at given amplitudes (prior sigmas).
VecX signature_of(const inference::Projector& projector,
                  const std::vector<std::pair<int, double>>& cause);

/// The strongest window of all; null if nothing was scanned.
const inference::Window* strongest_window(const search::Fitted& e);

}  // namespace drift::diagnosis
