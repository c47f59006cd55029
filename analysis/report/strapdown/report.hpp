#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/strapdown/identify.hpp"

namespace drift::report {

/// The result as tables for a terminal.
std::string to_text(const strapdown::StrapdownResult& result);

/// The result as JSON, schema 1. A number that is not finite is null.
nlohmann::json to_json(const strapdown::StrapdownResult& result);

}  // namespace drift::report
