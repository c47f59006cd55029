#pragma once

#include <string>

#include "analysis/identification/identify.hpp"

namespace drift::report {

/// The result for machines: JSON, schema 1. Values stand in the unit named beside them; what is not
/// a finite number is null.
std::string to_json(const mc::Study& study, const identification::Identification& id);

}  // namespace drift::report
