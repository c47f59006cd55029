#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/advice.hpp"

namespace drift::report {

/// An advice in words, for the person who plans the next test.
std::string advice_text(const diagnosis::Advice& advice);

/// The same where there is room for a few lines: more than two positions are counted, not listed.
std::string advice_in_brief(const diagnosis::Advice& advice);

/// The first of an answer in a few lines, and behind it the causes that no position separates:
/// positions that separate others leave open which of these it is. Effects that were asked for at
/// one prior sigma, as far as they were not found, may be many, and stand in the full answer.
std::string advice_in_brief(const std::vector<diagnosis::Advice>& advice);

/// What it is about: the alternatives in its pairs, in their order, each once.
std::vector<std::string> advised_labels(const diagnosis::Advice& advice);

}  // namespace drift::report
