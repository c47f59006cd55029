#pragma once

#include <vector>

#include "core/estimate/strapdown/case_test.hpp"

namespace drift::strapdown {

/// Sensors on a case, as a platform that is told what its gyros read (case_test.hpp).
struct CaseSensors {
  DriftModel model;
  Theta theta;  ///< SI, the platform's convention
};

/// What `others` would have read of the motion that `own` sensors read. Of every sample the rate of
/// the case and its specific force, the hand's part with it, are solved for with the sensors' own
/// model; what others read of them takes the place of what their own read there. Noise stays as it
/// is: within a dwell the motion is that of its means. test: laid out from these signals and
/// dwells; attitude, clock and covariates are those of its nearest node. Samples that were not
/// measured stay so. Models with memory, or that ask how a case turns, are not for this
/// (DRIFT_DEMAND).
Signals reread(const Signals& signals, const std::vector<Dwell>& dwells, const CaseTest& test,
               const CaseSensors& own, const CaseSensors& others);

}  // namespace drift::strapdown
