#include "analysis/cli/shell/two_ups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/physics/gimbals.hpp"
#include "core/plan/attitude_slips.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::cli {
namespace {

/// Between the Up of the accelerometers and that of the gimbals [rad]; the heading of the case
/// leaves it alone.
double apart(const TwoUps& s) {
  const Vec3 up = gimbal_chain(s.gimbals).row(2);
  return std::atan2(s.force.cross(up).norm(), s.force.dot(up));
}

using Undo = std::function<void(TwoUps&)>;

bool makes_one(const std::vector<TwoUps>& seen, const Undo& undo) {
  return std::ranges::all_of(seen, [&](TwoUps s) {
    undo(s);
    return apart(s) < largest_mismatch;
  });
}

/// The columns of one triple exchanged or reversed, the fewest changes that make the two one:
/// "acc_x is acc_y and acc_y is minus acc_x"; empty where none does, or several do.
std::string mixed_up(const std::vector<TwoUps>& seen, const ChannelTriple& channels,
                     Vec3 TwoUps::*triple) {
  std::string found;
  int fewest = 4;
  std::array<int, 3> from{0, 1, 2};
  do {
    for (unsigned signs = 0; signs < 8; ++signs) {
      const auto sign = [&](int i) { return (signs >> i & 1U) != 0 ? -1.0 : 1.0; };
      std::vector<std::string> changes;
      for (int i = 0; i < 3; ++i)
        if (from[i] != i || sign(i) < 0.0)
          changes.push_back(fmt::format("{} is {}{}", channels.names[i],
                                        sign(i) < 0.0 ? "minus " : "", channels.names[from[i]]));
      const int count = static_cast<int>(changes.size());
      if (count == 0 || count > fewest) continue;
      const auto undo = [&](TwoUps& s) {
        const Vec3 v = s.*triple;
        for (int i = 0; i < 3; ++i) (s.*triple)[i] = sign(i) * v[from[i]];
      };
      if (!makes_one(seen, undo)) continue;
      found = count == fewest ? "" : fmt::format("{}", fmt::join(changes, " and "));
      fewest = count;
    }
  } while (std::next_permutation(from.begin(), from.end()));
  return found;
}

/// The unit of the gimbal angles that makes the two one; of several the one that leaves less than
/// half of what any other does.
std::string in_another_unit(const std::vector<TwoUps>& seen, const Unit& unit) {
  std::vector<std::pair<double, std::string_view>> fitting;  // the worst left [rad]
  for (const auto& [symbol, to_si] : angle_units()) {
    if (to_si == unit.to_si) continue;
    double worst = 0.0;
    for (TwoUps s : seen) {
      s.gimbals *= to_si / unit.to_si;
      worst = std::max(worst, apart(s));
    }
    if (worst < largest_mismatch) fitting.emplace_back(worst, symbol);
  }
  std::ranges::sort(fitting);
  if (fitting.empty() || (fitting.size() > 1 && fitting[0].first > 0.5 * fitting[1].first))
    return "";
  return fmt::format("the numbers of the gimbal angles are [{}], not [{}]", fitting[0].second,
                     unit.symbol.view());
}

/// One gimbal whose zero is a quarter or half of a turn away; several are none.
std::string other_zero(const std::vector<TwoUps>& seen) {
  std::vector<std::string> found;
  for (int gimbal = 0; gimbal < 3; ++gimbal)
    for (const double zero : {-90.0, 90.0, 180.0})
      if (makes_one(seen, [&](TwoUps& s) { s.gimbals[gimbal] += zero * detail::deg; }))
        found.push_back(
            fmt::format("offset = {{ {} = \"{} deg\" }}", gimbal_channels.names[gimbal], zero));
  return found.size() == 1 ? found.front() : "";
}

}  // namespace

std::string two_ups_text(const std::vector<TwoUps>& seen, const Unit& unit) {
  std::vector<const TwoUps*> wrong;
  for (const TwoUps& s : seen)
    if (!(apart(s) < largest_mismatch)) wrong.push_back(&s);
  if (wrong.empty()) return "";
  std::vector<std::string> ways;
  if (seen.size() >= fewest_sights)
    for (std::string way : {in_another_unit(seen, unit), other_zero(seen),
                            mixed_up(seen, gimbal_channels, &TwoUps::gimbals),
                            mixed_up(seen, accelerometer_channels, &TwoUps::force)})
      if (!way.empty()) ways.push_back(std::move(way));
  return fmt::format(
      "The accelerometers and the gimbal angles show two different Ups in {} of {} positions "
      "(position {}: {:.0f} deg apart): columns of one of them have another unit, sign, order or "
      "zero than is taken here.{} Correct that first, in [recording] of the study file.",
      wrong.size(), seen.size(), wrong.front()->position, apart(*wrong.front()) / detail::deg,
      ways.empty() ? ""
                   : fmt::format(" They would be one {}with: {}.",
                                 ways.size() > 1 ? "(the recording does not show which) " : "",
                                 fmt::join(ways, "; or ")));
}

}  // namespace drift::cli
