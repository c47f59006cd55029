#include "core/plan/attitude_slips.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "core/physics/gimbals.hpp"
#include "core/plan/case_heading.hpp"

namespace drift {
namespace {

template <typename Undo>
bool brings_all_into_place(const std::vector<Sight>& sights, const Undo& undo) {
  return std::ranges::all_of(sights, [&](Sight s) {
    undo(s);
    return gimbal_mismatch(s) < largest_mismatch;
  });
}

/// Something that may be wrong with the heading of the case, and what to do.
struct HeadingSlip {
  void (*undo)(Sight&);
  std::string_view text;
};

constexpr HeadingSlip heading_slips[] = {
    {[](Sight& s) { s.heading = -s.heading; },
     "the sign of case_heading is wrong (it counts from North over West). Correct the recording, "
     "or say so in the study: [recording] columns = { case_heading = \"-case_heading\" }, with its "
     "unit as in the header"},
    {[](Sight& s) { s.heading = s.planned; },
     "case_heading is not that of the plan, the gimbals are. Leave the column out, or correct it"},
    {[](Sight& s) { s.heading = 0.0; },
     "the case faced North in all of them. Set case_heading = \"0 deg\" in the positions of the "
     "plan, or record case_heading"},
};

/// Columns that may be in another unit, as bits: gimbal_outer, gimbal_middle, gimbal_inner,
/// case_heading.
using Columns = unsigned;
constexpr std::string_view names[] = {"gimbal_outer", "gimbal_middle", "gimbal_inner",
                                      "case_heading"};
constexpr Columns gimbals = 7, heading = 8;

double& angle_of(Sight& s, int column) {
  return column < 3 ? s.seen[column] : s.heading;
}

void take_as(Sight& s, Columns columns, const AngleUnits& said, double to_si) {
  for (int i = 0; i < 4; ++i)
    if ((columns >> i & 1U) != 0) angle_of(s, i) *= to_si / said[static_cast<std::size_t>(i)].to_si;
}

/// Whether every one of the columns is somewhere at an angle that a plan can tell from none: a unit
/// that makes all of them nothing, or whole turns, would say nothing of the unit.
bool tells(const std::vector<Sight>& sights, Columns columns, const AngleUnits& said,
           double to_si) {
  for (int i = 0; i < 4; ++i) {
    if ((columns >> i & 1U) == 0) continue;
    if (std::ranges::none_of(sights, [&](Sight s) {
          take_as(s, columns, said, to_si);
          return std::abs(std::remainder(angle_of(s, i), 360.0 * detail::deg)) > largest_mismatch;
        }))
      return false;
  }
  return true;
}

/// Whether one of the columns says that it is in this unit: then fewer of them are in another one.
bool says(Columns columns, const AngleUnits& said, double to_si) {
  for (std::size_t i = 0; i < 4; ++i)
    if ((columns >> i & 1U) != 0 && said[i].to_si == to_si) return true;
  return false;
}

/// The one unit in which these columns would show the plan.
std::optional<std::string> in_another_unit(const std::vector<Sight>& sights, Columns columns,
                                           const AngleUnits& said) {
  std::vector<std::string_view> wrong, fitting;
  std::string_view was;
  for (std::size_t i = 0; i < 4; ++i) {
    if ((columns >> i & 1U) == 0) continue;
    wrong.push_back(names[i]);
    if (was.empty()) was = said[i].symbol.view();
  }
  for (const detail::BaseUnit& unit : detail::base_units)
    if (unit.dim == unit::rad.dim && !says(columns, said, unit.to_si) &&
        tells(sights, columns, said, unit.to_si) &&
        brings_all_into_place(sights, [&](Sight& s) { take_as(s, columns, said, unit.to_si); }))
      fitting.push_back(unit.symbol);
  if (fitting.size() != 1) return std::nullopt;
  const std::string last = std::string(wrong.back());
  wrong.pop_back();
  return fmt::format(
      "{}{}{} {} in another unit: the numbers look like [{}], not [{}]. Correct the unit{}",
      fmt::join(wrong, ", "), wrong.empty() ? "" : " and ", last, wrong.empty() ? "is" : "are",
      fitting.front(), was, wrong.empty() ? "" : "s");
}

}  // namespace

double gimbal_mismatch(const Sight& s) {
  const Mat3 R_lp = case_attitude(s.heading) * gimbal_chain(s.seen);
  return rotation_vector(s.R_lr.transpose() * R_lp).norm();
}

std::optional<std::string> slip_behind(const std::vector<Sight>& sights, const AngleUnits& units) {
  if (sights.size() < fewest_sights) return std::nullopt;
  if (auto text = in_another_unit(sights, gimbals, units)) return text;
  for (const HeadingSlip& slip : heading_slips)
    if (brings_all_into_place(sights, slip.undo)) return std::string(slip.text);
  // Of gimbals alone, or of the heading too, the fewest first.
  for (const Columns columns : {heading, gimbals | heading, 1U, 2U, 4U, 3U, 5U, 6U})
    if (auto text = in_another_unit(sights, columns, units)) return text;
  return std::nullopt;
}

}  // namespace drift
