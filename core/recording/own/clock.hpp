#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drift {

/// What comes first in a date such as 03/04/2026 or 03-04-2026.
enum class StrokeDates { day_first, month_first };

/// Seconds of a time of day "13:05:10.25", "01:05:10.25 PM", "13:05", "13.05.10" or "13:05:10Z", or
/// of a date and time "2026-03-01T13:05:10.25Z", "01.03.2026 13:05:10,25", "01/03/2026 13:05:10",
/// "01-Mar-2026 13:05:10" or "20260301T130510+02" since 1970. Empty if the text is none.
std::optional<double> parse_clock(std::string_view text,
                                  StrokeDates order = StrokeDates::day_first);

/// Whether a text is a date alone, as it stands before the time of day in those.
bool is_date(std::string_view text, StrokeDates order = StrokeDates::day_first);

/// Reads a column of such times. Whether the day or the month of dates such as 03/04/2026 is first
/// shows where the date changes: the other way the recording would be interrupted for weeks.
class Clock {
 public:
  /// dates_apart: dates and times of day are columns of their own, and a date may be written a
  /// little late: where it makes the time go back by a day at midnight, the next day is taken.
  explicit Clock(bool dates_apart = false) : dates_apart_(dates_apart) {}
  /// Seconds since the first time; empty, and nothing changes, if the text is no time.
  std::optional<double> read(std::string_view cell);
  /// The first time as it stands in the file; empty before it.
  const std::string& zero() const { return zero_; }
  /// Times whose date was that of the day before.
  std::size_t late_dates() const { return readings_.front().late; }
  /// What was chosen of two ways to read the dates; empty if there was no choice.
  std::string remark() const;

 private:
  /// One way to read dates.
  struct Reading {
    StrokeDates order = StrokeDates::day_first;
    std::optional<double> first{}, last{};  ///< [s] since 1970, or of the day
    double midnights = 0.0;                 ///< [s] passed with times of day
    bool ahead = false;  ///< a date came a day and more after the one before, and no midnight since
    std::size_t late = 0;  ///< dates of the day before
    std::optional<double> advance(std::string_view cell, bool dates_apart);
    void take_late_date(double& now);
  };

  std::vector<Reading> readings_{{.order = StrokeDates::day_first},
                                 {.order = StrokeDates::month_first}};
  bool dates_apart_ = false;
  double seconds_ = 0.0;  ///< of the row before
  std::string zero_, decided_;
};

}  // namespace drift
