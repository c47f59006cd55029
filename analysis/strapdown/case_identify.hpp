#pragma once

#include <vector>

#include "analysis/strapdown/case_errors.hpp"
#include "analysis/strapdown/case_study.hpp"
#include "analysis/strapdown/findings.hpp"
#include "analysis/strapdown/score.hpp"

namespace drift::strapdown {

/// A filter of the study fitted to a strapdown recording, all parameters with one covariance.
struct CaseFit {
  std::string name;
  Coupling equation = Coupling::eq5;           ///< as the study has it
  BatchResult fit;                             ///< of the platform's filter (case_filter)
  std::vector<StrapdownParameter> parameters;  ///< of which the recording says more than the prior
  std::vector<Unobservable> unobservable;      ///< the others
  Score up, gyro, gravity;                     ///< [deg], [deg/h], [g]; empty without held-out data
};

/// What a unit whose gyros see the Earth says of its sensors.
struct CaseIdentification {
  CaseStudy study;
  int folds = 0;              ///< into which the dwells were divided; 0: too few to hold any out
  std::vector<CaseFit> fits;  ///< of every filter
  /// Paired gain of eq. (5) over eq. (6) on held-out ways, in standard errors; NaN without both.
  double eq5_gain = 0.0;
};

/// Estimates every filter by fit_batch, and again without each sixth of the dwells, to predict
/// these and the ways that begin there. A parameter is said with its number where the recording
/// says ten times as much of it as the prior (learned_ratio), or as a sum with others (known_sums);
/// of any other what it is one with, or that the recording says little of it.
CaseIdentification identify_case(const mc::Study& study, CaseStudy of);

}  // namespace drift::strapdown
