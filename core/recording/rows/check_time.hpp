#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/recording/recording.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {

/// The line of a row, for messages; rows that have none are counted from 1.
std::size_t line_of(const Recording& recording, std::size_t row);

/// Counts that many rows from 1 where they have no lines.
void number_rows(Recording& recording, std::size_t rows);

/// Where a row is, for messages: "line:column".
std::string place_in(const Recording& recording, std::size_t row, std::string_view column);

/// After how many seconds a clock begins again of which a step back in time [s] may be: within an
/// hour over midnight one of 24 hours, over the end of a week the time of the week of GPS. Empty:
/// of neither.
std::optional<double> begins_again_after(double before, double after);

/// Adds a problem for every row without a time or with one that does not come after those before;
/// one for all rows where so many share a time that it is written too coarsely.
void check_time(const Recording& recording, Problems& problems);

/// Whether the rows come in the order of time.
enum class RowOrder { known, broken };

/// Adds a problem for every row without a position of the plan, or with one that comes after a
/// later one.
void check_position(const Recording& recording, RowOrder order, Problems& problems);

/// Adds a problem for every row that is neither of a dwell nor of a slew.
void check_phase(const Recording& recording, Problems& problems);

}  // namespace drift
