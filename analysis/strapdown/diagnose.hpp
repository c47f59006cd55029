#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/strapdown/identify.hpp"
#include "mc/study/study.hpp"

namespace drift::strapdown {

/// A diagnosis of a strapdown recording and the identification it rests on.
struct StrapdownDiagnosis {
  StrapdownResult result;
  diagnosis::Diagnosis diagnosis;
};

/// Diagnoses sensors on a case: what must be added to the first filter of the study so that dwells
/// and turns held out of the fit are predicted.
///
/// The nominal model is what the first filter's terms estimate: of the gyros D_F, s, eta and xi, D;
/// of the accelerometers K0 and K1, dP and dO, K2. Causes are the parts of the accepted model
/// (identify_strapdown) that it lacks; a nominal eq6 that eq5 beats on held-out turns by two
/// standard errors is named as frame_closure. Positions are dwells, counted from 1; the turn that
/// starts from a dwell belongs to it. A recording declares no noise: residuals are in units of the
/// scatter that the accepted model leaves, so its own chi-square in sample is 1.
///
/// p values: Student's t of the paired held-out gain, Bonferroni over all models tried.
/// Probabilities: from the gain of the held-out log score, equal odds before. Errors as
/// identify_strapdown; InputError (config) if the study has no filter.
StrapdownDiagnosis diagnose_strapdown(const mc::Study& study, const Recording& recording,
                                      StrapdownOptions options);

}  // namespace drift::strapdown
