#include "analysis/preparation/gimbal_branch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace drift::preparation {
namespace {

constexpr double half_turn = std::numbers::pi;

/// Within half a turn of zero.
double wrapped(double angle) {
  return std::remainder(angle, 2.0 * half_turn);
}

Channel* channel_of(Recording& r, std::string_view name) {
  for (Channel& c : r.channels)
    if (c.name == name) return &c;
  return nullptr;
}

}  // namespace

void take_usual_branch(Recording& r, std::vector<std::string>& remarks) {
  Channel *const outer = channel_of(r, "gimbal_outer"),
                 *const middle = channel_of(r, "gimbal_middle"),
                 *const inner = channel_of(r, "gimbal_inner");
  if (outer == nullptr || middle == nullptr || inner == nullptr) return;
  // Beyond a turn it is another unit, or turns are counted: whoever looks at that says so.
  for (const Channel* gimbal : {outer, middle, inner})
    for (const double angle : gimbal->values)
      if (std::abs(angle) > 2.0 * half_turn) return;
  std::size_t turned = 0, line = 0;
  for (std::size_t k = 0; k < r.rows(); ++k) {
    const double m = wrapped(middle->values[k]);
    // Not true of what is not measured.
    if (!(std::abs(m) > 0.5 * half_turn) || !std::isfinite(outer->values[k] + inner->values[k]))
      continue;
    if (turned++ == 0) line = r.lines[k];
    outer->values[k] = wrapped(outer->values[k] + half_turn);
    middle->values[k] = wrapped(half_turn - m);
    inner->values[k] = wrapped(inner->values[k] + half_turn);
  }
  if (turned == 0) return;
  remarks.push_back(fmt::format(
      "{}: the middle gimbal reads more than 90 deg from its zero in {} rows from line {} on: "
      "taken as the same attitude by outer + 180 deg, 180 deg - middle, inner + 180 deg",
      r.source.empty() ? "recording" : r.source, turned, line));
}

}  // namespace drift::preparation
