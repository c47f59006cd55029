#include "core/plan/attitude_slips.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string_view>

#include "core/physics/gimbals.hpp"
#include "core/plan/case_heading.hpp"

namespace drift {
namespace {

/// How far the worst of all is then from the attitude of the plan [rad].
template <typename Undo>
double worst_mismatch(const std::vector<Sight>& sights, const Undo& undo) {
  double worst = 0.0;
  for (const Sight& sight : sights) {
    Sight s = sight;
    undo(s);
    const double mismatch = gimbal_mismatch(s);
    if (!(mismatch <= worst)) worst = mismatch;
  }
  return worst;
}
template <typename Undo>
bool brings_all_into_place(const std::vector<Sight>& sights, const Undo& undo) {
  return worst_mismatch(sights, undo) < largest_mismatch;
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
constexpr std::string_view column_names[] = {"gimbal_outer", "gimbal_middle", "gimbal_inner",
                                             "case_heading"};
constexpr Columns all_gimbals = 7, of_case = 8;

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

/// The one unit in which these columns would show the plan; of several the one that leaves less
/// than half of what any other does.
std::optional<std::string> in_another_unit(const std::vector<Sight>& sights, Columns columns,
                                           const AngleUnits& said) {
  std::vector<std::string_view> wrong;
  std::vector<std::pair<double, std::string_view>> fitting;  // what they leave [rad]
  std::string_view was;
  for (std::size_t i = 0; i < 4; ++i) {
    if ((columns >> i & 1U) == 0) continue;
    wrong.push_back(column_names[i]);
    if (was.empty()) was = said[i].symbol.view();
  }
  for (const auto& [symbol, to_si] : angle_units()) {
    if (says(columns, said, to_si) || !tells(sights, columns, said, to_si)) continue;
    const double worst =
        worst_mismatch(sights, [&, unit = to_si](Sight& s) { take_as(s, columns, said, unit); });
    if (worst < largest_mismatch) fitting.emplace_back(worst, symbol);
  }
  std::ranges::sort(fitting);
  if (fitting.empty() || (fitting.size() > 1 && fitting[0].first > 0.5 * fitting[1].first))
    return std::nullopt;
  const std::string last = std::string(wrong.back());
  wrong.pop_back();
  return fmt::format(
      "{}{}{} {} in another unit: the numbers look like [{}], not [{}]. Correct the unit{}",
      fmt::join(wrong, ", "), wrong.empty() ? "" : " and ", last, wrong.empty() ? "is" : "are",
      fitting.front().second, was, wrong.empty() ? "" : "s");
}

/// What is to be added to the gimbal angles [deg].
using Zeros = std::array<double, 3>;

double worst_with(const std::vector<Sight>& sights, const Zeros& zeros) {
  return worst_mismatch(sights, [&](Sight& s) {
    for (int i = 0; i < 3; ++i) s.seen[i] += zeros[static_cast<std::size_t>(i)] * detail::deg;
  });
}

/// What is left on average.
double mean_with(const std::vector<Sight>& sights, const Zeros& zeros) {
  double sum = 0.0;
  for (Sight s : sights) {
    for (int i = 0; i < 3; ++i) s.seen[i] += zeros[static_cast<std::size_t>(i)] * detail::deg;
    sum += gimbal_mismatch(s);
  }
  return sum / static_cast<double>(sights.size());
}

/// The zero of one gimbal that leaves least, to 0.1 deg.
Zeros best_zero_of(const std::vector<Sight>& sights, std::size_t gimbal) {
  Zeros best{}, tried{};
  double least = worst_with(sights, best);
  for (const double step : {5.0, 1.0, 0.1}) {
    const double centre = best[gimbal], room = step == 5.0 ? 180.0 : 10.0 * step;
    for (double zero = centre - room; zero < centre + room + 0.5 * step; zero += step) {
      tried[gimbal] = zero;
      if (const double left = worst_with(sights, tried); left < least) {
        least = left;
        best = tried;
      }
    }
  }
  return best;
}

/// Zeros of the gimbals that bring all into place: of one gimbal any, else of two a quarter of a
/// turn or half of one. Several ways are none.
std::optional<Zeros> zeros_behind(const std::vector<Sight>& sights) {
  std::vector<Zeros> fitting;
  const auto take = [&](const Zeros& zeros) {
    // One that is put on all because a few are off brings the others nearly out of place.
    if (worst_with(sights, zeros) < largest_mismatch &&
        mean_with(sights, zeros) < 0.5 * mean_with(sights, {}))
      fitting.push_back(zeros);
  };
  for (std::size_t gimbal = 0; gimbal < 3; ++gimbal) take(best_zero_of(sights, gimbal));
  if (fitting.empty())
    for (std::size_t still = 0; still < 3; ++still)
      for (const double a : {-90.0, 90.0, 180.0})
        for (const double b : {-90.0, 90.0, 180.0}) {
          Zeros zeros{a, a, a};
          zeros[still] = 0.0;
          zeros[still == 2 ? 1 : 2] = b;
          take(zeros);
        }
  return fitting.size() == 1 ? std::optional(fitting.front()) : std::nullopt;
}

std::string zeros_text(const Zeros& zeros) {
  std::vector<std::string> columns, keys;
  for (std::size_t i = 0; i < 3; ++i) {
    if (zeros[i] == 0.0) continue;
    columns.push_back(fmt::format("{} reads {:.4g} deg too {}", column_names[i], std::abs(zeros[i]),
                                  std::abs(zeros[i]) == 180.0 ? "much or too little"
                                  : zeros[i] < 0.0            ? "much"
                                                              : "little"));
    keys.push_back(fmt::format("{} = \"{:.4g} deg\"", column_names[i], zeros[i]));
  }
  return fmt::format(
      "{}, in all of them. Correct the zero, or say so in the study: [recording] offset = {{ {} }}",
      fmt::join(columns, " and "), fmt::join(keys, ", "));
}

}  // namespace

double gimbal_mismatch(const Sight& s) {
  const Mat3 R_lp = case_attitude(s.heading) * gimbal_chain(s.seen);
  return rotation_vector(s.R_lr.transpose() * R_lp).norm();
}

std::vector<std::pair<std::string_view, double>> angle_units() {
  std::vector<std::pair<std::string_view, double>> all{{"gon", 0.9 * detail::deg}};
  for (const detail::BaseUnit& unit : detail::base_units)
    if (unit.dim == unit::rad.dim) all.emplace_back(unit.symbol, unit.to_si);
  return all;
}

std::string unit_there(const std::vector<Sight>& sights, const AngleUnits& units) {
  for (const std::string_view symbol : {"deg", "rad", "gon", "mrad"})
    for (const auto& [angle_unit, to_si] : angle_units())
      if (angle_unit == symbol && !says(all_gimbals, units, to_si) &&
          worst_mismatch(sights, [&, unit = to_si](Sight& s) {
            take_as(s, all_gimbals, units, unit);
          }) < largest_mismatch)
        return fmt::format(
            ". With angles in [{}], not [{}], they would be where the plan has them: is that part "
            "of the log in another unit?",
            angle_unit, units[0].symbol.view());
  return "";
}

std::optional<std::string> slip_behind(const std::vector<Sight>& sights, const AngleUnits& units) {
  if (sights.size() < fewest_sights) return std::nullopt;
  if (auto text = in_another_unit(sights, all_gimbals, units)) return text;
  for (const HeadingSlip& slip : heading_slips)
    if (brings_all_into_place(sights, slip.undo)) return std::string(slip.text);
  // Of gimbals alone, or of the heading too, the fewest first.
  for (const Columns columns : {of_case, all_gimbals | of_case, 1U, 2U, 4U, 3U, 5U, 6U})
    if (auto text = in_another_unit(sights, columns, units)) return text;
  if (const auto zeros = zeros_behind(sights)) return zeros_text(*zeros);
  return std::nullopt;
}

std::optional<RowMistake> middle_beyond_a_turn(const std::vector<Sight>& sights,
                                               const AngleUnits& units) {
  constexpr double turn = 360.0 * detail::deg, room = detail::deg;
  const auto beyond = std::ranges::find_if(
      sights, [](const Sight& s) { return std::abs(s.seen[1]) > turn + room; });
  if (beyond == sights.end()) return std::nullopt;
  std::string advice = "Correct its unit, or which column it is";
  const auto middle = [](const Sight& s) { return s.seen[1]; };
  const auto [least, most] = std::ranges::minmax(sights, {}, middle);
  const double turns = std::floor((middle(least) + 0.25 * turn + room) / turn);
  if (const auto unit = in_another_unit(sights, 2U, units))
    advice = *unit;
  else if (middle(most) - turns * turn < turn + room)
    advice = fmt::format(
        "Take the whole turns off, or say so in the study: [recording] offset = {{ gimbal_middle = "
        "\"{:.0f} deg\" }}",
        -360.0 * turns);
  return RowMistake{beyond->row,
                    "gimbal_middle shows more than a turn (expected at most 90 deg to either side, "
                    "or 0 to 360 deg). " +
                        advice};
}

}  // namespace drift
