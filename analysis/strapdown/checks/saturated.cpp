#include "analysis/strapdown/checks/saturated.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/nan.hpp"
#include "core/base/words.hpp"

namespace drift::strapdown {
namespace {

/// Outside them nothing is made of what gyros read.
bool is_between(const TurnOf& turn, const std::vector<Dwell>& dwells) {
  return turn.number > 0 && turn.number < dwells.size();
}

}  // namespace

std::vector<Saturation> leave_out_saturated(Recording& recording) {
  std::vector<Saturation> all = saturated_gyros(recording);
  for (const Saturation& s : all) {
    const auto gyro = std::ranges::find(recording.channels, s.channel, &Channel::name);
    for (const std::size_t row : s.rows) gyro->values[row] = nan_value;
  }
  return all;
}

std::vector<TurnOf> turns_of(const std::vector<std::size_t>& rows, const std::vector<double>& time,
                             const std::vector<Dwell>& dwells) {
  std::vector<TurnOf> turns;
  for (const std::size_t row : rows) {
    const auto behind =
        std::ranges::partition_point(dwells, [&](const Dwell& d) { return d.first <= row; });
    const auto number = static_cast<std::size_t>(behind - dwells.begin());
    if (turns.empty() || turns.back().number != number) turns.push_back({number, time[row]});
  }
  return turns;
}

std::string saturated_turns_text(const Saturation& s, const Recording& recording,
                                 const std::vector<Dwell>& dwells) {
  constexpr std::size_t most = 6;
  std::vector<std::string> numbered, where;
  for (const TurnOf& turn : turns_of(s.rows, recording.find("time")->values, dwells)) {
    const std::string at = fmt::format("at {:.6g} s", turn.time);
    if (turn.number == 0)
      where.push_back(fmt::format("before the first dwell ({})", at));
    else if (turn.number >= dwells.size())
      where.push_back(fmt::format("behind the last dwell ({})", at));
    else
      numbered.push_back(fmt::format("{} ({})", turn.number, at));
  }
  if (!numbered.empty())
    where.insert(where.begin(), fmt::format("in turn{} {}", numbered.size() == 1 ? "" : "s",
                                            listed_up_to(numbered, most)));
  return fmt::format("{} {}", s.channel, listed(where, "and"));
}

std::string saturation_text(const std::vector<Saturation>& all, const Recording& recording,
                            const std::vector<Dwell>& dwells) {
  std::vector<std::string> said;
  for (const Saturation& s : all) {
    if (std::ranges::none_of(turns_of(s.rows, recording.find("time")->values, dwells),
                             [&](const TurnOf& t) { return is_between(t, dwells); }))
      continue;
    const std::string where = saturated_turns_text(s, recording, dwells),
                      rate = fmt::format("{:.5g} deg/s", s.value / detail::deg);
    said.push_back(s.at == Saturation::At::between
                       ? fmt::format("{} stands still for {} samples at {}, longer than its noise "
                                     "lets it",
                                     where, s.rows.size(), rate)
                       : fmt::format("{} reads {}, its {} of all, in {} rows, more often than "
                                     "noise reads one value",
                                     where, rate,
                                     s.at == Saturation::At::low ? "least" : "greatest",
                                     s.rows.size()));
  }
  if (said.empty()) return "";
  return fmt::format(
      "{}. A gyro at the end of its range (or stuck) does not say how fast the unit turns: these "
      "rows are left out, and the turns with them. Turn more slowly, or set a larger range",
      fmt::join(said, "; "));
}

}  // namespace drift::strapdown
