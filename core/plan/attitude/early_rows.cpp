#include "core/plan/attitude/early_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>
#include <vector>

#include "core/plan/attitude_slips.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

/// The last rows of positions in which a column tells whose it is, by number, and those of them in
/// which it reads as the next position.
struct LastRows {
  std::size_t telling = 0;
  std::vector<std::size_t> as_next{};

  bool early() const { return telling > 0 && as_next.size() == telling; }
  bool right() const { return telling >= fewest_sights && as_next.empty(); }
};

using LastRowsOfThree = std::array<LastRows, 3>;

/// How far two readings are apart, of angles within half a turn.
double reads_apart(double a, double b, bool angles) {
  return std::abs(angles ? std::remainder(a - b, 2.0 * std::numbers::pi) : a - b);
}

LastRowsOfThree last_rows(const Recording& recording, const Timeline& timeline,
                          const ChannelTriple& channels) {
  LastRowsOfThree all;
  const bool angles = channels.names == gimbal_channels.names;
  const auto& intervals = timeline.intervals;
  for (std::size_t next = 2; next < intervals.size(); ++next) {
    const std::size_t last = next - 1, before = next - 2;
    if (!intervals[next].cage || intervals[next].slew || intervals[last].slew ||
        intervals[next].position == intervals[last].position ||
        intervals[last].position != intervals[before].position)
      continue;
    const auto own = measured(recording, channels, before),
               at = measured(recording, channels, last),
               other = measured(recording, channels, next);
    if (!own || !at || !other) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      // [rad] of an angle, [g] of Up, which turns by as much.
      if (reads_apart((*own)[k], (*other)[k], angles) < largest_mismatch) continue;
      LastRows& column = all[i];
      ++column.telling;
      if (reads_apart((*at)[k], (*other)[k], angles) < reads_apart((*at)[k], (*own)[k], angles))
        column.as_next.push_back(last);
    }
  }
  return all;
}

/// Of columns that tell; false where none does.
bool all_right(const LastRowsOfThree& columns) {
  bool right = false;
  for (const LastRows& c : columns) {
    if (!c.as_next.empty()) return false;
    right = right || c.right();
  }
  return right;
}

}  // namespace

std::optional<RowMistake> early_columns(const Recording& recording, const Timeline& timeline) {
  const LastRowsOfThree of_acc = last_rows(recording, timeline, accelerometer_channels),
                        of_gimbals = last_rows(recording, timeline, gimbal_channels);
  for (const bool acc : {true, false}) {
    const LastRowsOfThree& suspect = acc ? of_acc : of_gimbals;
    if (!all_right(acc ? of_gimbals : of_acc)) continue;
    std::vector<std::string_view> names;
    std::set<std::size_t> rows;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!suspect[i].early()) continue;
      names.push_back((acc ? accelerometer_channels : gimbal_channels).names[i]);
      rows.insert(suspect[i].as_next.begin(), suspect[i].as_next.end());
    }
    if (rows.size() < fewest_sights) continue;
    const bool one = names.size() == 1;
    return RowMistake{
        *rows.begin(),
        fmt::format("the last row of {} positions already shows the attitude of the next: "
                    "column{} {} stand{} a row early (expected readings and number of one "
                    "instant in a row). Correct the export",
                    rows.size(), one ? "" : "s", fmt::join(names, ", "), one ? "s" : "")};
  }
  return std::nullopt;
}

}  // namespace drift
