#include "core/recording/rows/turned_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/count_positions.hpp"

namespace drift {
namespace {

bool is_none(double position) {
  return std::isnan(position) || (position < 1.0 && position == std::floor(position));
}

/// Rows [first, last) of one number, or of none.
struct TurnedStretch {
  std::size_t first = 0, last = 0;
  bool none = false;
};

std::vector<TurnedStretch> stretches_of(const std::vector<double>& position) {
  std::vector<TurnedStretch> all;
  for (std::size_t k = 0; k < position.size(); ++k) {
    const bool none = is_none(position[k]);
    const bool same = k > 0 && (none ? all.back().none : position[k] == position[k - 1]);
    if (same)
      all.back().last = k + 1;
    else
      all.push_back({k, k + 1, none});
  }
  return all;
}

/// Whether rows without a number are there, and lie where a platform is turned: between positions,
/// or before and behind all of them if no number stands there (0 may be that of a first position).
bool are_turns(const std::vector<double>& position, const std::vector<TurnedStretch>& all) {
  bool turns = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const TurnedStretch& s = all[i];
    if (!s.none && s.last - s.first < CountLimits::fewest_rows) return false;
    if (!s.none) continue;
    const bool at_an_end = i == 0 || i + 1 == all.size();
    if (!at_an_end && position[s.first - 1] == position[s.last]) return false;
    turns = turns || !at_an_end || std::isnan(position[s.first]);
  }
  return turns && all.size() > 1;
}

bool slewed(const Recording& r, const Channel* phase, std::size_t row) {
  if (phase != nullptr) return phase->values[row] == 1.0;
  const auto command = measured(r, command_channels, row);
  return command && command->norm() > CountLimits::slew;
}

}  // namespace

void leave_out_rows(Recording& r, const std::vector<bool>& out) {
  const auto without = [&](auto& values) {
    std::size_t k = 0;
    std::erase_if(values, [&](const auto&) { return out[k++]; });
  };
  for (Channel& c : r.channels) without(c.values);
  without(r.lines);
}

void take_turned_rows(Recording& r) {
  const auto channel = std::ranges::find(r.channels, "position", &Channel::name);
  if (channel == r.channels.end()) return;
  std::vector<double>& position = channel->values;
  const std::vector<TurnedStretch> all = stretches_of(position);
  if (!are_turns(position, all)) return;
  const Channel* phase = r.find("phase");
  std::vector<bool> out(position.size(), false);
  std::vector<double> slews(position.size(), 0.0);
  std::size_t left_out = 0, slewing = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const TurnedStretch& s = all[i];
    if (!s.none) continue;
    std::size_t first = s.last, last = s.last;  // of the rows that are slewed
    for (std::size_t k = s.first; k < s.last; ++k)
      if (i > 0 && i + 1 < all.size() && slewed(r, phase, k)) {
        first = std::min(first, k);
        last = k;
      }
    for (std::size_t k = s.first; k < s.last; ++k) {
      out[k] = first == s.last;
      ++(out[k] ? left_out : slewing);
      if (out[k]) continue;
      position[k] = position[k < first ? s.first - 1 : s.last];
      slews[k] = k >= first && k <= last ? 1.0 : 0.0;
    }
  }
  if (phase == nullptr && slewing > 0) r.channels.push_back({"phase", unit::one, std::move(slews)});
  const auto rows = [](std::size_t n) { return fmt::format("{} row{}", n, n == 1 ? "" : "s"); };
  std::string text =
      fmt::format("{} have no number of a position, or 0: ", rows(left_out + slewing));
  if (slewing > 0) text += fmt::format("{} are taken as the way to the next", rows(slewing));
  if (left_out > 0)
    text += fmt::format("{}{} in which no command turns it are left out", slewing > 0 ? "; " : "",
                        rows(left_out));
  r.remarks.add(Weight::doubtful, text);
  leave_out_rows(r, out);
}

}  // namespace drift
