#pragma once

#include <string>

#include "analysis/identification/identify.hpp"

namespace drift {

/// The result for people: plain text of at most 100 columns, for standard output.
std::string to_text(const Study& study, const Identification& id);

}  // namespace drift
