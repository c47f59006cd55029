#include "core/plan/shifted_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/nan.hpp"
#include "core/plan/attitude_slips.hpp"
#include "core/plan/slew_check.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

constexpr std::size_t fewest_positions = 3, fewest_rows = 2;
constexpr std::size_t part =
    4;  // of a position, at either end, in which a jump is one of its number

/// Rows from a jump in the position to its last, and from its first to a jump; 0: there is none.
struct Jumps {
  std::size_t before_last = 0, behind_first = 0;
};

Jumps jumps_in(const Recording& r, std::size_t first, std::size_t last) {
  const std::size_t count = last - first + 1;
  const auto attitude = [&](std::size_t k) {
    const auto angles = measured(r, gimbal_channels, k);
    return local_attitude_shown(r, k, angles.value_or(Vec3::Constant(nan_value)));
  };
  Jumps out;
  Mat3 before = attitude(first);
  for (std::size_t k = first + 1; k <= last; ++k) {
    const Mat3 now = attitude(k);
    const double turned = rotation_vector(Mat3(now * before.transpose())).norm();
    before = now;
    if (!(turned > largest_mismatch)) continue;
    if (last - k + 1 <= count / part) out.before_last = last - k + 1;
    if (k - first <= count / part) out.behind_first = k - first;
  }
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
  for (std::size_t first = 0, row = 1; row <= r.rows(); ++row) {
    if (row < r.rows() && position->values[row] == position->values[first]) continue;
    const Jumps jumps = jumps_in(r, first, row - 1);
    if (jumps.before_last > 0 && row < r.rows() && caged(position->values[row]))
      ++late[jumps.before_last];
    if (jumps.behind_first > 0 && first > 0 && caged(position->values[first]))
      ++early[jumps.behind_first];
    first = row;
  }
  const auto one = [](const auto& counts) {
    return counts.size() == 1 && counts.begin()->first >= fewest_rows &&
           counts.begin()->second >= fewest_positions;
  };
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
