#include "core/plan/late_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace drift {
namespace {

/// Columns of three, as bits.
constexpr unsigned every_column = 7;

/// The next row of its position that was measured: rows that are lost behind the first are there
/// without readings. The number of rows where there is none.
std::size_t next_row(const Recording& recording, const Sight& s, const ChannelTriple& channels) {
  const Channel* position = recording.find("position");
  for (std::size_t row = s.row + 1; row < recording.rows(); ++row) {
    if (position != nullptr && position->values[row] != position->values[s.row]) break;
    if (measured(recording, channels, row)) return row;
  }
  return recording.rows();
}

/// What it shows.
std::optional<Vec3> next_of(const Recording& recording, const Sight& s,
                            const ChannelTriple& channels) {
  const std::size_t row = next_row(recording, s, channels);
  return row < recording.rows() ? measured(recording, channels, row) : std::nullopt;
}

/// What the last row before that of a sight shows that was measured.
std::optional<Vec3> last_of(const Recording& recording, const Sight& s,
                            const ChannelTriple& channels) {
  for (std::size_t row = s.row; row-- > 0;)
    if (const auto seen = measured(recording, channels, row)) return seen;
  return std::nullopt;
}

/// How far apart two rows read in these columns: of angles within half a turn.
double apart(const Vec3& a, const Vec3& b, const ChannelTriple& channels, unsigned columns) {
  Vec3 off = Vec3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i)
    if ((columns >> i & 1U) != 0) off[i] = a[i] - b[i];
  if (channels.names == gimbal_channels.names)
    for (double& x : off) x = std::remainder(x, 2.0 * std::numbers::pi);
  return off.norm();
}

/// Whether these columns read what they read in the row before. A dwell in which drift crosses the
/// limit of what is elsewhere between its first two rows is not late. Nobody knows of what has no
/// row before.
bool reads_as_before(const Recording& recording, const Sight& s, const Vec3& next,
                     const ChannelTriple& channels, unsigned columns) {
  const auto last = last_of(recording, s, channels);
  return !last || apart(s.seen, *last, channels, columns) < apart(s.seen, next, channels, columns);
}

}  // namespace

std::vector<std::size_t> late_columns(const Recording& recording, const std::vector<Sight>& wrong,
                                      const ChannelTriple& channels, Mismatch mismatch) {
  if (wrong.size() < fewest_sights) return {};
  const auto explain = [&](unsigned columns) {
    return std::ranges::all_of(wrong, [&](const Sight& s) {
      const auto next = next_of(recording, s, channels);
      if (!next || !reads_as_before(recording, s, *next, channels, columns)) return false;
      Vec3 seen = s.seen;
      for (Eigen::Index i = 0; i < 3; ++i)
        if ((columns >> i & 1U) != 0) seen[i] = (*next)[i];
      return mismatch(s, seen) < largest_mismatch;
    });
  };
  for (const unsigned columns : {1U, 2U, 4U, 3U, 5U, 6U, every_column}) {
    if (!explain(columns)) continue;
    std::vector<std::size_t> late;
    for (std::size_t i = 0; i < 3; ++i)
      if ((columns >> i & 1U) != 0) late.push_back(i);
    return late;
  }
  return {};
}

std::size_t rows_on_the_way(const Recording& recording, const std::vector<Sight>& wrong,
                            const ChannelTriple& channels, Mismatch mismatch) {
  const Channel *position = recording.find("position"), *heading = recording.find("case_heading");
  if (position == nullptr) return 0;
  std::size_t most = 0;
  for (Sight s : wrong) {
    const auto same = [&](std::size_t row) {
      return row < recording.rows() && position->values[row] == position->values[s.row];
    };
    const double first = mismatch(s, s.seen);
    std::size_t end = s.row, row = s.row + 1;
    while (same(end)) ++end;
    for (const std::size_t last = s.row + (end - s.row) / parts_of_a_position; row <= last; ++row) {
      const auto seen = measured(recording, channels, row);
      if (heading != nullptr) s.heading = heading->values[row];
      if (seen && mismatch(s, *seen) < std::min(largest_mismatch, 0.5 * first)) break;
      if (row == last) return 0;
    }
    most = std::max(most, row - s.row);
  }
  return most;
}

bool numbers_early(const Recording& recording, const std::vector<Sight>& wrong,
                   const ChannelTriple& channels, Mismatch mismatch) {
  const Channel* heading = recording.find("case_heading");
  return wrong.size() >= fewest_sights && std::ranges::all_of(wrong, [&](Sight s) {
           const auto next = next_of(recording, s, channels);
           if (!next || !reads_as_before(recording, s, *next, channels, every_column)) return false;
           if (heading != nullptr) s.heading = heading->values[next_row(recording, s, channels)];
           return mismatch(s, *next) < largest_mismatch;
         });
}

}  // namespace drift
