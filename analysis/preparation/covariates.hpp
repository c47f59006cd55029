#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// What a test tells beside the platform's own channels, one value per interval.
struct Covariate {
  std::string name;
  std::vector<double> value;
};

/// Everything that recordings hold beside the platform's own channels, one after another; NaN where
/// one of them lacks it, or has another quantity under its name.
std::vector<Covariate> covariates_of(const std::vector<Recording>& recordings);

/// Messages about terms of the study's filters that need the temperature, where the recording has
/// a column that looks like one and is mapped as nothing.
std::vector<std::string> unmapped_temperature_of_terms(const mc::Study& study,
                                                       const Recording& recording);

}  // namespace drift::preparation
