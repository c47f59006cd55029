#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "analysis/identification/delay_doubt.hpp"
#include "analysis/report/page/json.hpp"

namespace drift::report {

/// That accelerometers and gimbals are of different instants, by how much, and what that mends.
std::string delay_text(const identification::DelayDoubt& delay);
/// What to do about it; command: that is given again.
std::string delay_next(const identification::DelayDoubt& delay, std::string_view command);

/// `instants` of identification.json and diagnosis.json; null if nothing is said of them.
Json delay_json(const std::optional<identification::DelayDoubt>& delay);

}  // namespace drift::report
