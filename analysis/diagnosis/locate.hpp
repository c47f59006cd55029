#pragma once

#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/diagnosis/recovered.hpp"

namespace drift::discovery {

/// Where the misfit sits. signature: the whitened, cleaned columns' best combination (what explains
/// the misfit), one value per row; its product with the residual, row by row, is shared out between
/// channels and positions. Windows: those significant at threshold, overlapping ones once.
Where locate(const Examination& e, const Nulls& nulls, const VecX& signature,
             std::size_t most_windows);

/// Whitened residual signature of candidate columns at given amplitudes (prior sigmas).
VecX signature_of(const Projector& projector, const std::vector<std::pair<int, double>>& cause);

/// The same of a window's box at the amplitude that fits best.
VecX signature_of(const LinearProblem& problem, const Timeline& timeline,
                  const Projector& projector, const Window& window);

/// The strongest window of all; null if nothing was scanned.
const Window* strongest_window(const Examination& e);

}  // namespace drift::discovery
