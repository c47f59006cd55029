#pragma once

#include <string>

#include "analysis/identification/identify.hpp"

namespace drift {

/// The result for machines: JSON, schema 1. Values stand in the unit named beside them; what is not
/// a finite number is null.
std::string to_json(const Study& study, const Identification& id);

}  // namespace drift
