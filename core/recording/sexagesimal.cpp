#include "core/recording/sexagesimal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "core/stats/normal.hpp"

namespace drift {

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
