#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/diagnosis/findings/remark.hpp"
#include "analysis/diagnosis/findings/where.hpp"
#include "analysis/report/diagnosis/words/instrument.hpp"

namespace drift::report {

/// A remark in words, for a test engineer. recordings: of several, which it names.
std::string in_words(const diagnosis::Remark& remark, Instrument instrument = Instrument::platform,
                     const std::vector<diagnosis::RecordingSpan>& recordings = {});

/// "This plan cannot tell the nominal eq. (6) from eq. (5)"; positions: "this plan", as a subject.
std::string cannot_tell_equations(const diagnosis::remark::OtherEquation& open,
                                  std::string_view positions);

}  // namespace drift::report
