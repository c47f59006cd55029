#pragma once

#include <string>

#include "analysis/diagnosis/findings/remark.hpp"

namespace drift::report {

/// A remark in words, for a test engineer.
std::string in_words(const diagnosis::Remark& remark);

/// "This plan cannot tell the nominal eq. (6) from eq. (5)".
std::string cannot_tell_equations(const diagnosis::remark::OtherEquation& open);

}  // namespace drift::report
