#include "core/plan/shifted_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/nan.hpp"
#include "core/plan/attitude_slips.hpp"
#include "core/plan/slew_check.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

constexpr std::size_t fewest_positions = 3, fewest_rows = 2;

/// Rows from the first jump in the end of the position to its last, and from its first to the only
/// jump in its begin; 0: there is none.
struct Jumps {
  std::size_t before_last = 0, behind_first = 0;
};

/// NaN where it is not shown.
Mat3 attitude_in(const Recording& r, std::size_t row) {
  const auto angles = measured(r, gimbal_channels, row);
  return local_attitude_shown(r, row, angles.value_or(Vec3::Constant(nan_value)));
}

double angle_between(const Mat3& a, const Mat3& b) {
  return rotation_vector(Mat3(a * b.transpose())).norm();
}

Jumps jumps_in(const Recording& r, std::size_t first, std::size_t last) {
  const std::size_t count = last - first + 1;
  const auto attitude = [&](std::size_t k) { return attitude_in(r, k); };
  const auto apart = [](const Mat3& a, const Mat3& b) {
    return angle_between(a, b) > largest_mismatch;
  };
  Jumps out;
  std::size_t in_begin = 0, in_end = 0;
  const Mat3 at_first = attitude(first), at_last = attitude(last);
  Mat3 before = at_first;
  for (std::size_t k = first + 1; k <= last; ++k) {
    const Mat3 now = attitude(k), was = std::exchange(before, now);
    if (!apart(now, was)) continue;
    const bool at_begin = k - first <= count / parts_of_a_position,
               at_end = last - k + 1 <= count / parts_of_a_position;
    if (!at_begin && !at_end) return {};  // angles that jump all the while
    // A reading that is none is no turn: it comes back.
    if (at_end && in_end++ == 0 && apart(at_last, was)) out.before_last = last - k + 1;
    if (at_begin && in_begin++ == 0 && apart(now, at_first)) out.behind_first = k - first;
  }
  if (in_begin > 1) out.behind_first = 0;  // turned on the way: attitude_mistakes() tells
  return out;
}

}  // namespace

std::string shifted_numbers(const Recording& r, const TestPlan& plan) {
  const Channel* position = r.find("position");
  if (position == nullptr) return "";
  for (const std::string_view name : gimbal_channels.names)
    if (r.find(name) == nullptr) return "";
  const auto caged = [&](double number) {
    const auto k = static_cast<std::size_t>(std::max(0.0, number));
    return k >= 1 && k <= plan.positions.size() && plan.positions[k - 1].entry == Entry::caged;
  };
  std::map<std::size_t, std::size_t> late, early;  // rows, in how many positions
  std::size_t stays = 0;  // positions behind which it does not jump where the number changes
  for (std::size_t first = 0, row = 1; row <= r.rows(); ++row) {
    if (row < r.rows() && position->values[row] == position->values[first]) continue;
    const Jumps jumps = jumps_in(r, first, row - 1);
    if (jumps.before_last > 0 && row < r.rows() && caged(position->values[row])) {
      ++late[jumps.before_last];
      if (angle_between(attitude_in(r, row - 1), attitude_in(r, row)) < largest_mismatch) ++stays;
    }
    if (jumps.behind_first > 0 && first > 0 && caged(position->values[first]))
      ++early[jumps.behind_first];
    first = row;
  }
  const auto one = [](const auto& counts) {
    return counts.size() == 1 && counts.begin()->first >= fewest_rows &&
           counts.begin()->second >= fewest_positions;
  };
  std::size_t on_the_way = 0;  // positions at whose end the platform turns in two rows or more
  for (const auto& [rows, positions] : late)
    if (rows >= fewest_rows) on_the_way += positions;
  const bool all_stay = on_the_way > 0 && stays == on_the_way && late.begin()->first >= fewest_rows;
  if (!one(late) && early.empty() && (on_the_way >= fewest_positions || all_stay))
    return fmt::format(
        "{}: the last rows of {} position{}, up to {}, show the platform in the next or on the way "
        "to it (expected rows of a position alone). Write 0 as their number, leave them out, or "
        "let "
        "the number change so much earlier",
        r.source.empty() ? "recording" : r.source, on_the_way, on_the_way == 1 ? "" : "s",
        late.rbegin()->first);
  const bool is_late = one(late) && early.empty(), is_early = one(early) && late.empty();
  if (!is_late && !is_early) return "";
  const auto& [rows, positions] = is_late ? *late.begin() : *early.begin();
  return fmt::format(
      "{}: the {} {} rows of {} positions show the attitude of the {}: the numbers of the "
      "positions "
      "change {} rows too {} (expected with the platform). Let them change so many rows {}, or "
      "leave "
      "these rows out",
      r.source.empty() ? "recording" : r.source, is_late ? "last" : "first", rows, positions,
      is_late ? "next" : "one before", rows, is_late ? "late" : "early",
      is_late ? "earlier" : "later");
}

}  // namespace drift
