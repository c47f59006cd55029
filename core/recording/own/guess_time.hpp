#pragma once

#include "core/recording/own/guess.hpp"

namespace drift {

/// Whether the texts of a column are all dates, or all times of a clock.
bool holds_dates(const GuessedColumn& column);
bool holds_times(const GuessedColumn& column);

/// A counter that stands for time where nothing else does.
void guess_counter(GuessedFile& file);

/// The one column of texts that are all times of a clock is the time, whatever it is called; the
/// one column of dates that change stands before the times of day in it.
void name_time_by_values(GuessedFile& file);

/// A time in numbers that begins again at midnight, or with the week, is a counter of as many
/// counts as make a day, or a week.
void count_clock_of_numbers(GuessedFile& file);

}  // namespace drift
