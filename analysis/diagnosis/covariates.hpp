#pragma once

#include <vector>

#include "analysis/diagnosis/recovered.hpp"
#include "core/recording/recording.hpp"

namespace drift::diagnosis {

/// Everything that recordings hold beside the platform's own channels, one after another; NaN where
/// one of them lacks it.
std::vector<Covariate> covariates_of(const std::vector<Recording>& recordings);

}  // namespace drift::diagnosis
