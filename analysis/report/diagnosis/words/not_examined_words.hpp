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
/// it may be that; empty if nothing of the library was left out for want of a covariate.
std::string lacking_covariate_text(const std::vector<diagnosis::NotExamined>& all,
                                   const RecordingSpans& recordings);

/// " What wanders may follow the temperature, which was not recorded: record it to tell it from
/// noise."; empty where nothing was left out for want of a covariate that varies.
std::string followed_text(const std::vector<diagnosis::NotExamined>& all,
                          const RecordingSpans& recordings);

/// "Next: give b.csv the temperature, or leave it out, and diagnose again: ..." of what some
/// recordings of several lack; or empty.
std::string lacking_in_some_next(const std::vector<diagnosis::NotExamined>& all,
                                 const RecordingSpans& recordings);

/// "look up whether the temperature was the same in all recordings", where none has it; or empty.
std::string lacking_in_all_text(const std::vector<diagnosis::NotExamined>& all);

/// "mine, a term of the study: b.csv lacks the column oil.": the study asks for it, so a short
/// answer does, too; empty if none of its own terms was left out for want of a covariate.
std::string own_not_examined_text(const std::vector<diagnosis::NotExamined>& all,
                                  const RecordingSpans& recordings);

/// "Next: give b.csv the column oil, or leave it out, and diagnose again: ..." of the first such
/// term; or empty.
std::string own_not_examined_next(const std::vector<diagnosis::NotExamined>& all,
                                  const RecordingSpans& recordings);

}  // namespace drift::report
