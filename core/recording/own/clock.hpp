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
  /// Seconds since the first time; empty, and nothing changes, if the text is no time.
  std::optional<double> read(std::string_view cell);
  /// The first time as it stands in the file; empty before it.
  const std::string& zero() const { return zero_; }
  /// What was chosen of two ways to read the dates; empty if there was no choice.
  std::string remark() const;

 private:
  /// One way to read dates.
  struct Reading {
    StrokeDates order = StrokeDates::day_first;
    std::optional<double> first{}, last{};  ///< [s] since 1970, or of the day
    double midnights = 0.0;                 ///< [s] passed with times of day
    std::optional<double> advance(std::string_view cell);
  };

  std::vector<Reading> readings_{{.order = StrokeDates::day_first},
                                 {.order = StrokeDates::month_first}};
  double seconds_ = 0.0;  ///< of the row before
  std::string zero_, decided_;
};

}  // namespace drift
