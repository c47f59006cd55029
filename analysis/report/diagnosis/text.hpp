#pragma once

#include <string>

#include "analysis/diagnosis/diagnosis.hpp"

namespace drift {

/// The diagnosis on one screen of a terminal, for a test engineer: verdict, where, causes, the
/// strongest candidates, before and after, what moved, noise that is not as declared, advice.
std::string to_text(const discovery::Diagnosis& diagnosis);

}  // namespace drift
