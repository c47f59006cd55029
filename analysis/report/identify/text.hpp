#pragma once

#include <string>

#include "analysis/identification/identify.hpp"

namespace drift::report {

/// The result for people: plain text of at most 100 columns, for standard output.
std::string to_text(const mc::Study& study, const identification::Identification& id);

}  // namespace drift::report
