#pragma once

#include <string>
#include <vector>

#include "core/params/covariates.hpp"
#include "core/recording/recording.hpp"
#include "core/recording/rows/smooth_reading.hpp"

namespace drift::preparation {

/// A covariate whose rate terms follow (a number), of a recording that has it in steps.
struct SteppedCovariate {
  std::size_t recording = 0;  ///< its number, from 0
  const CovariateSpec* covariate = nullptr;
  SmoothReading reading;
};

/// Of recordings as their files have them, before rows are joined.
std::vector<SteppedCovariate> stepped_covariates(const std::vector<Recording>& recordings);

/// Puts what they show in place of the readings, at the end of every row that has one, and says so.
void take_smooth(const std::vector<SteppedCovariate>& stepped, std::vector<Recording>& recordings,
                 std::vector<std::string>& remarks);

}  // namespace drift::preparation
