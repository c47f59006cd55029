#pragma once

#include <string>
#include <string_view>

#include "analysis/identification/latitude_doubt.hpp"
#include "analysis/report/page/json.hpp"

namespace drift::report {

/// "45.712±0.019 deg".
std::string latitude_text(const identification::LatitudeDoubt& doubt);
/// "latitude", or "latitude or times" where nothing tells which.
std::string_view wrong_text(const identification::LatitudeDoubt& doubt);
/// "; or the times ...": what else it may be; empty where it is the latitude.
std::string or_clock_text(const identification::LatitudeDoubt& doubt);
/// What accelerometers on a case that all have the wrong sign look like; empty: not like this.
std::string upside_down_text(const identification::LatitudeDoubt& doubt);
/// "Next: diagnose again with ...": the number where the recording knows it as well as a survey, a
/// map where it does not; command: that is to be given again.
std::string latitude_next(const identification::LatitudeDoubt& doubt, std::string_view command);
/// Of a doubt without a clock; null of any other.
Json latitude_json(const std::optional<identification::LatitudeDoubt>& doubt);

}  // namespace drift::report
