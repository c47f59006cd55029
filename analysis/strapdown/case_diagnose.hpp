#pragma once

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/strapdown/case_identify.hpp"

namespace drift::strapdown {

/// Diagnoses sensors on a case as a platform is diagnosed: every effect of the library that they
/// can have, two at once, the noise, probabilities, dwells held out. What is found is in the
/// sensors' convention (as_sensed), channels gyro_x to gyro_z stand for the gyros at rest, eqs. (5)
/// and (6) are those of the study. Errors before and after are of dwells and turns held out. id: of
/// the same study, whose first filter is the nominal model.
diagnosis::Diagnosis diagnose_case(const mc::Study& study, const CaseIdentification& id,
                                   const diagnosis::DiagnoseOptions& options = {});

}  // namespace drift::strapdown
