#include "core/recording/sexagesimal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/recording/own/csv_cells.hpp"
#include "core/stats/normal.hpp"

namespace drift {

std::optional<double> angle_in_minutes_and_seconds(std::string_view text) {
  constexpr std::array<std::string_view, 7> marks = {"\u00B0", "\u2032", "\u2033", "'",
                                                     "\"",     ":",      " "};
  const bool marked = text.find(marks[0]) != std::string_view::npos;
  std::vector<std::string> parts(1);
  while (!text.empty()) {
    const auto mark =
        std::ranges::find_if(marks, [&](std::string_view m) { return text.starts_with(m); });
    if (mark == marks.end())
      parts.back() += text.front();
    else if (!parts.back().empty())
      parts.emplace_back();
    text.remove_prefix(mark == marks.end() ? 1 : mark->size());
  }
  if (parts.back().empty()) parts.pop_back();
  if (parts.size() > 3 || parts.size() < (marked ? 1 : 3)) return std::nullopt;
  double angle = cell_number(parts[0]), part = 1.0;
  const bool whole = angle == std::trunc(angle) || parts.size() == 1;
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const double number = cell_number(parts[k]);
    const bool last = k + 1 == parts.size();
    if (!(number >= 0.0 && number < 60.0) || (!last && number != std::trunc(number)))
      return std::nullopt;
    part /= 60.0;
    angle += parts[0].starts_with('-') ? -part * number : part * number;
  }
  return whole && std::isfinite(angle) ? std::optional(angle) : std::nullopt;
}

double angle_from_minutes_and_seconds(double number) {
  constexpr double rounding = 1e-6;  // ["], of a number in binary
  const double size = std::abs(number), degrees = std::floor(size + 1e-4 * rounding),
               in_minutes = 1e2 * (size - degrees),
               minutes = std::floor(in_minutes + 1e-2 * rounding),
               seconds = std::max(0.0, 1e2 * (in_minutes - minutes));
  if (minutes >= 60.0 || seconds >= 60.0 - rounding)
    return std::numeric_limits<double>::quiet_NaN();
  return std::copysign(degrees + minutes / 60.0 + seconds / 3600.0, number);
}

void MinutesAndSeconds::look_at(const std::vector<double>& degrees) {
  constexpr double rounding = 1e-3;  // of the last digit: 45.3015 is a little less in binary
  std::set<long> visited;
  long before = 0, here = -1;       // hundredths of a degree
  std::bitset<most_pairs> of_here;  // seconds
  for (const double x : degrees) {
    if (!may_be_ || !(std::abs(x) < 1e6)) continue;
    const auto digits = static_cast<long>(std::floor(1e4 * std::abs(x) + rounding));
    const long hundredth = digits / 100, seconds = digits % 100;
    ++numbers_;
    may_be_ = hundredth % 100 < 60 && seconds < 60;
    if (hundredth != here) {
      const bool passed = std::abs(here - before) == 1 && hundredth - here == here - before;
      if (passed) seconds_ |= of_here;
      before = std::exchange(here, hundredth);
      of_here.reset();
      if (visited.insert(here).second) seconds_.set(static_cast<std::size_t>(seconds));
    }
    of_here.set(static_cast<std::size_t>(seconds));
  }
  seconds_.reset(0);
}

double MinutesAndSeconds::chance() const {
  double chance = 1.0;
  for (std::size_t k = 0; may_be_ && k < seconds_.count(); ++k)
    chance *= (59.0 - static_cast<double>(k)) / (99.0 - static_cast<double>(k));
  return chance;
}

std::string MinutesAndSeconds::text() const {
  if (!(chance() < stats::beyond_5_sigma)) return "";
  return fmt::format(
      "the angles seem to be degrees, minutes and seconds in one number: in none of {} is the "
      "first or the second pair of decimals 60 or more (by chance: {:.0e})",
      numbers_, chance());
}

}  // namespace drift
