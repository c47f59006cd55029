#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "analysis/identification/latitude_doubt.hpp"
#include "analysis/report/page/json.hpp"

namespace drift::report {

/// "The times of the recording are not those of the platform: ..."; of a doubt that has a clock.
std::string clock_text(const identification::LatitudeDoubt& doubt);
/// "Next: multiply the times ..."; command: that is to be given again.
std::string clock_next(const identification::ClockDoubt& clock, std::string_view command);
/// "Times that are all too short would leave the same: ...", of a nominal model that needs nothing
/// else then.
std::string times_instead_text(const identification::ClockDoubt& clock);
/// The same without the fits, where there is no room for more.
std::string times_in_brief(const identification::ClockDoubt& clock);
/// "0.2 % too long".
std::string times_off_text(const identification::ClockDoubt& clock);
/// "times that are all 0.2 % too long would leave as little (...)", of a cause that is not alone.
/// odds: of the times against it.
std::string times_as_little_text(const identification::ClockDoubt& clock, double odds);
/// Factor and fits; null of none.
Json times_json(const std::optional<identification::ClockDoubt>& clock);
/// Of a doubt that has a clock; null of any other.
Json clock_json(const std::optional<identification::LatitudeDoubt>& doubt);

}  // namespace drift::report
