#pragma once

#include <string>

#include "analysis/diagnosis/diagnosis.hpp"

namespace drift::report {

/// The diagnosis on one screen of a terminal, for a test engineer: verdict, where, causes, the
/// strongest candidates, before and after, what moved, noise that is not as declared, advice.
std::string to_text(const diagnosis::Diagnosis& diagnosis);

}  // namespace drift::report
