#pragma once

#include "analysis/inference/noise/noise.hpp"

namespace drift::inference {

/// White noise alone, from differences of neighbouring residuals: what is left of a residual that a
/// grossly wrong model bends. residual: in declared sigmas, not whitened. shape rows.
NoiseEstimate noise_of_differences(const MeasuredRows& rows, const VecX& residual);

/// Whether the misfit is so gross that it would be taken for noise: chi-square per row thirty times
/// what the differences of neighbouring residuals allow. (Random walks of ten times the usual size
/// give three to ten.)
bool grossly_wrong(const MeasuredRows& rows, const VecX& residual,
                   const NoiseEstimate& differences);

}  // namespace drift::inference
