#pragma once

#include <string>

#include "analysis/identification/heading_doubt.hpp"
#include "analysis/report/page/json.hpp"

namespace drift::report {

/// "The positions headed otherwise than the plan says: all of them turned by 45 deg about Up, from
/// North toward West".
std::string turned_text(const identification::HeadingDoubt& doubt);

/// `heading` of diagnosis.json, `heading_doubt` of identification.json.
Json heading_json(const identification::HeadingDoubt& doubt);

}  // namespace drift::report
