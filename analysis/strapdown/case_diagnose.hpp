#pragma once

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/strapdown/case_study.hpp"

namespace drift::strapdown {

/// Diagnoses a unit whose gyros see the Earth, as a platform is diagnosed: every effect of the
/// library that sensors on a case can have, two at once, the noise, probabilities, dwells held out.
/// What is found is in the sensors' convention (as_sensed), channels gyro_x to gyro_z stand for the
/// gyros at rest, eqs. (5) and (6) are those of the study. InputError (config) without a filter.
diagnosis::Diagnosis diagnose_case(const mc::Study& study, const CaseStudy& of,
                                   const diagnosis::DiagnoseOptions& options = {});

}  // namespace drift::strapdown
