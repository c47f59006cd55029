#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// What a test tells beside the platform's own channels, one value per interval.
struct Covariate {
  std::string name;
  std::vector<double> value;
};

/// Everything that recordings hold beside the platform's own channels, one after another; NaN where
/// one of them lacks it.
std::vector<Covariate> covariates_of(const std::vector<Recording>& recordings);

}  // namespace drift::preparation
