#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/not_examined.hpp"
#include "analysis/diagnosis/findings/where.hpp"

namespace drift::report {

/// Where the recordings stand in what follows (Where::recordings): what one of several lacks is
/// said of that one.
using RecordingSpans = std::vector<diagnosis::RecordingSpan>;

/// "it follows the temperature, which was not recorded in b.csv".
std::string reason_in_words(const diagnosis::NotExamined& left_out,
                            const RecordingSpans& recordings);

/// What was left out of the comparison, a sentence for each reason.
std::vector<std::string> not_examined_sentences(const std::vector<diagnosis::NotExamined>& all,
                                                const RecordingSpans& recordings);

/// Of those that may stand behind a named cause, for the verdict; empty if none may.
std::string unexamined_twins_text(const std::vector<diagnosis::NotExamined>& all);

/// " Not examined: temperature_drift: the temperature was not recorded.": of what is unexplained,
/// it may be that; empty if nothing was left out for want of a covariate.
std::string lacking_covariate_text(const std::vector<diagnosis::NotExamined>& all,
                                   const RecordingSpans& recordings);

/// " What wanders may follow the temperature, which was not recorded: record it to tell it from
/// noise."; empty where nothing was left out for want of a covariate that varies.
std::string followed_text(const std::vector<diagnosis::NotExamined>& all,
                          const RecordingSpans& recordings);

}  // namespace drift::report
