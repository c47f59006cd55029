#include "analysis/preparation/gimbal_branch.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/recording/recording_channels.hpp"

namespace drift::preparation {
namespace {

constexpr double half_turn = std::numbers::pi;

/// Within half a turn of zero.
double wrapped(double angle) {
  return std::remainder(angle, 2.0 * half_turn);
}

/// Beyond it is another unit, or turns are counted: whoever looks at that says so. With room for
/// what the readings around a row add to one near a whole turn.
constexpr double a_turn = 361.0 * detail::deg;

/// Rows in which the middle gimbal reads more than 90 deg from its zero and all three are measured.
std::vector<std::size_t> rows_beyond(const Recording& r) {
  std::array<const Channel*, 3> of{};
  for (std::size_t i = 0; i < 3; ++i)
    if (of[i] = r.find(gimbal_channels.names[i]); of[i] == nullptr) return {};
  for (const Channel* gimbal : of)
    for (const double angle : gimbal->values)
      if (std::abs(angle) > a_turn) return {};
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < r.rows(); ++k)
    if (std::abs(wrapped(of[1]->values[k])) > 0.5 * half_turn &&
        std::isfinite(of[0]->values[k] + of[2]->values[k]))
      rows.push_back(k);
  return rows;
}

}  // namespace

std::string other_branch(const Recording& r) {
  const std::vector<std::size_t> rows = rows_beyond(r);
  if (rows.empty()) return "";
  return fmt::format(
      "{}: the middle gimbal reads more than 90 deg from its zero in {} rows from line {} on: "
      "taken as the same attitude by outer + 180 deg, 180 deg - middle, inner + 180 deg",
      r.source.empty() ? "recording" : r.source, rows.size(), r.lines[rows.front()]);
}

void take_usual_branch(Recording& r) {
  const std::vector<std::size_t> rows = rows_beyond(r);
  const auto& [outer, middle, inner] = gimbal_channels.names;
  for (Channel& c : r.channels)
    if (c.name == outer || c.name == middle || c.name == inner)
      for (const std::size_t k : rows)
        c.values[k] = wrapped(half_turn + (c.name == middle ? -c.values[k] : c.values[k]));
}

}  // namespace drift::preparation
