#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "analysis/report/page/report.hpp"
#include "analysis/strapdown/case_identify.hpp"

namespace drift::report {

/// What the identification of a strapdown recording says in a few lines.
InBrief case_in_brief(const strapdown::CaseIdentification& id);

/// What an instrument is called: "gravity in dwells".
std::string_view instrument_name(strapdown::Instrument of);
/// What is said of one that leaves more than noise does; factor: of its parameters' sigmas.
std::string instrument_text(const strapdown::InstrumentFit& fit);

/// "x 12.345 y ... deg above the horizon".
std::string up_of(const strapdown::Dwell& dwell);
/// Where an axis of the case points in the first dwell, as the gyros have it.
strapdown::AxisHeading first_heading(const strapdown::CaseIdentification& id);
/// What is said of North.
std::string azimuth_sentence(const strapdown::CaseIdentification& id);
/// "1 turn", "2 turns".
std::string counted(std::size_t n, std::string_view what);
/// Which equation predicts held-out turns better.
std::string contest_sentence(const strapdown::CaseIdentification& id);

}  // namespace drift::report
