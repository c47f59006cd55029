#pragma once

#include <string>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"

namespace drift::report {

/// Which alternative the patched model holds, where the verdict leaves several open (or one that
/// held-out data do not support); empty of any other verdict.
std::string patch_text(const diagnosis::Diagnosis& d);

/// What a recovered signal looks like: "grows evenly with time (correlation 0.97)".
std::string shape_text(const diagnosis::RecoveredSignal& signal,
                       const std::vector<diagnosis::RecordingSpan>& recordings = {});

/// The verdict for a test engineer: words first, keys and numbers in brackets. Alternatives of an
/// ambiguous verdict are numbered as in the table of causes; those whose signatures are one
/// direction on this plan are said to leave the same trace.
std::string sentence(const diagnosis::Diagnosis& d);

}  // namespace drift::report
