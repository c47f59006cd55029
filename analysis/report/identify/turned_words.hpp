#pragma once

#include <string>
#include <string_view>

#include "analysis/identification/heading_doubt.hpp"
#include "analysis/report/page/json.hpp"

namespace drift::report {

/// "The positions headed otherwise than the plan says: all of them turned by 45 deg about Up, from
/// North toward West".
std::string turned_text(const identification::HeadingDoubt& doubt);

/// What to do then: `command` again, with what.
std::string corrected_text(const identification::HeadingDoubt& doubt, std::string_view command);

/// `heading` of diagnosis.json, `heading_doubt` of identification.json.
Json heading_json(const identification::HeadingDoubt& doubt);

}  // namespace drift::report
