#include "analysis/strapdown/checks/saturated.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/nan.hpp"
#include "core/base/words.hpp"

namespace drift::strapdown {
namespace {

std::string turn_text(const TurnOf& turn, std::size_t dwells) {
  const std::string at = fmt::format("at {:.6g} s", turn.time);
  if (turn.number == 0) return fmt::format("before the first dwell ({})", at);
  if (turn.number >= dwells) return fmt::format("behind the last dwell ({})", at);
  return fmt::format("{} ({})", turn.number, at);
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
  std::vector<std::string> turns;
  for (const TurnOf& turn : turns_of(s.rows, recording.find("time")->values, dwells))
    turns.push_back(turn_text(turn, dwells.size()));
  return fmt::format("{}: in turn{} {}", s.channel, turns.size() == 1 ? "" : "s",
                     listed_up_to(turns, most));
}

std::string saturation_text(const Saturation& s, const Recording& recording,
                            const std::vector<Dwell>& dwells) {
  const std::string where = saturated_turns_text(s, recording, dwells),
                    rate = fmt::format("{:.5g} deg/s", s.value / detail::deg);
  if (s.at == Saturation::At::between)
    return fmt::format(
        "{} {} stands still for {} samples, at {}, where its noise lets it for less: stuck, or at "
        "the end of its range, and left out with the turn. Look at the sensor and its range",
        where, s.channel, s.rows.size(), rate);
  return fmt::format(
      "{} {} rows read {}, its {} of all, more often than noise reads one value: it is at the end "
      "of its range, and does not say how fast the unit turns. The rows are left out, and the "
      "turns with them. Turn more slowly, or set a larger range",
      where, s.rows.size(), rate, s.at == Saturation::At::low ? "least" : "greatest");
}

}  // namespace drift::strapdown
