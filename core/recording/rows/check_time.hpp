#pragma once

#include <string>
#include <string_view>

#include "core/recording/recording.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {

/// Where a row is, for messages: "line:column".
std::string place_in(const Recording& recording, std::size_t row, std::string_view column);

/// Whether a step back in time [s] may be that of a clock of 24 hours: over midnight within an
/// hour.
bool begins_again_at_midnight(double before, double after);

/// Adds a problem for every row without a time or with one that does not come after those before;
/// one for all rows where so many share a time that it is written too coarsely.
void check_time(const Recording& recording, Problems& problems);

}  // namespace drift
