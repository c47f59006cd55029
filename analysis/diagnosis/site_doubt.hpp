#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::diagnosis {

/// Asks whether a wrong [site] latitude is behind a misfit. Where causes were found, the latitude
/// competes with them, fitted without them: given where it leaves nothing, with its odds, one study
/// of 1000 saying another latitude; it is `less_likely` where these are worse. Beyond that: as a
/// cause, latitude_error is an error of the survey, of some arcsec; one of degrees loses against
/// its prior, is not linear, and another cause may be named in its place;
/// identification::latitude_doubt() fits the model, with the cause that was found, at other
/// latitudes, and says when it is given.
///
/// Beside causes, and where there are none, asked only where the verdict is `unexplained`, where
/// latitude_error is among the strongest candidates, where parameters lie far outside their priors,
/// or where chi-square of a `consistent` fit, priors included, is above its band.
/// recordings: as they were diagnosed. Empty otherwise.
std::optional<identification::LatitudeDoubt> site_doubt(const mc::Study& study,
                                                        const std::vector<Recording>& recordings,
                                                        const Diagnosis& diagnosis);

}  // namespace drift::diagnosis
