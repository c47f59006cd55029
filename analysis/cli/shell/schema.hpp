#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drift::cli {

/// JSON schema (draft 2020-12) of the study file. What it refuses the program refuses; the program
/// refuses more: what one key asks of another, and units that do not fit.
nlohmann::ordered_json study_schema();

/// The keys that --set takes, dotted, without those inside of lists: "plan.dwell".
std::vector<std::string> settable_keys();

}  // namespace drift::cli
