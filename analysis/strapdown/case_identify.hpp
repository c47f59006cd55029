#pragma once

#include <optional>
#include <vector>

#include "analysis/identification/latitude_doubt.hpp"
#include "analysis/strapdown/case_held_out.hpp"
#include "analysis/strapdown/checks/instrument_fit.hpp"
#include "analysis/strapdown/findings.hpp"

namespace drift::strapdown {

/// A filter of the study fitted to a strapdown recording, all parameters with one covariance.
struct CaseFit : Findings, CaseScores {
  std::string name;
  Coupling equation = Coupling::eq5;            ///< as the study has it
  BatchResult fit;                              ///< of the platform's filter (case_filter)
  std::vector<InstrumentFit> instruments = {};  ///< what its chi-square is made of
};

/// What a strapdown recording says of its sensors.
struct CaseIdentification {
  CaseStudy study;
  Division division;          ///< by which dwells were held out
  std::uint64_t seed = 1;     ///< of that and of the bootstrap
  std::vector<CaseFit> fits;  ///< of every filter
  /// Paired gain of eq. (5) over eq. (6) on held-out ways, in standard errors; NaN without both.
  double eq5_gain = 0.0;
  /// The latitude that the recording is of, if it is not that of [site].
  std::optional<identification::LatitudeDoubt> latitude = {};
};

/// Estimates every filter by fit_batch, says what of its parameters the recording knows
/// (findings_of), and how well it predicts what was held out (scores_of). InputError (config)
/// without a filter, with one that is neither eq. (5) nor eq. (6), since gyros on a case have no
/// servo, or as mc::require_own_terms().
CaseIdentification identify_case(const mc::Study& study, CaseStudy of);
/// Of a recording, with what its gyros say of the latitude (latitude_doubt()).
CaseIdentification identify_case(const mc::Study& study, const Recording& recording);

}  // namespace drift::strapdown
