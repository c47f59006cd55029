#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::diagnosis {

/// What may be said of the latitude, and, where it is not all, the diagnosis at the one found.
struct SiteFinding {
  std::optional<identification::LatitudeDoubt> doubt;
  std::shared_ptr<const Diagnosis> there;
};

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
///
/// Where the latitude takes nine tenths of a misfit away and leaves something, and what else was
/// found is nothing or of no size that a prior knows, the test is diagnosed again at that latitude,
/// whose error is one of the parameters then: with effects of usual sizes beside it, it stands.
///
/// options: of that diagnosis.
/// recordings: as they were diagnosed. Empty otherwise.
SiteFinding site_doubt(const mc::Study& study, const std::vector<Recording>& recordings,
                       const Diagnosis& diagnosis, const DiagnoseOptions& options = {});

/// A latitude at which the nominal model was fitted against the causes that were found: whether it
/// leaves as little, and where it leaves nothing significant its odds.
identification::LatitudeDoubt against_causes(identification::LatitudeDoubt doubt,
                                             const Diagnosis& diagnosis);

/// Asks whether the clock of the recording may stand in place of the causes that were found: where
/// nothing is commanded, times that are all too long or too short by one factor leave the trace of
/// another Earth's rate, and so does an error of the latitude, or sensitivities to the field or to
/// base motion that are alike on all axes. As of another latitude the evidence for it must be
/// stronger than such recordings are rare (ClockDoubt::evident()), and it must leave as little as
/// the causes do; where none was found, what a right model leaves with a
/// chance of SearchLimits::alpha or more. The clock is followed only where it promises a part
/// (SiteLimits::promise) of what the causes gain, or of the whole misfit where there are none.
/// Empty otherwise, of a test that lacks nothing, and where such times are told with another
/// latitude. With it go the odds of such times against the causes (TimesInstead). recordings: as
/// they were diagnosed; of a unit on a case the next one asks.
std::optional<remark::TimesInstead> times_instead(const mc::Study& study,
                                                  const std::vector<Recording>& recordings,
                                                  const Diagnosis& diagnosis);

/// The clock that leaves least of the misfit, where it promises as much off chi-square
/// (identification::clock_of_misfit()).
using ClockOfMisfit = std::function<std::optional<identification::ClockDoubt>(double promised)>;
/// The same of any test. under_found_noise: where noise was found that drives the platform beyond
/// what is declared, the clock that leaves least under it; such noise may be all that other times
/// stand for, so it must be evident then as well, and is the one that is told. Of a case times are
/// told where they have at least one in RemarkLimits::decided of the odds against the causes.
std::optional<remark::TimesInstead> times_instead(const ClockOfMisfit& clock_of_misfit,
                                                  const Diagnosis& diagnosis,
                                                  const ClockOfMisfit& under_found_noise = {});

}  // namespace drift::diagnosis
