#pragma once

#include "analysis/inference/noise/noise.hpp"

namespace drift::inference {

/// White noise alone, from differences of neighbouring residuals: what is left of a residual that a
/// grossly wrong model bends. residual: in declared sigmas, not whitened. shape rows.
NoiseEstimate noise_of_differences(const MeasuredRows& rows, const VecX& residual);

/// Whether the misfit is so gross that it would be taken for noise of any size: chi-square per row
/// thirty times what the differences of neighbouring residuals allow.
bool grossly_wrong(const MeasuredRows& rows, const VecX& residual,
                   const NoiseEstimate& differences);

/// Whether some noise drives the platform and all that does is of a size that instruments have
/// (NoisePrior::usual): it explains a gross misfit as well as a wrong model does.
bool driven_as_usual(const MeasuredRows& rows, const NoiseEstimate& noise,
                     const NoiseModel& declared);

}  // namespace drift::inference
