#include "core/plan/slew_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/physics/gimbals.hpp"
#include "core/plan/attitude_slips.hpp"
#include "core/plan/mixup.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

constexpr std::size_t fewest_turns = 3;
/// Part of what was commanded by which a turn may be another one: no scale factor is off by so
/// much, and of exchanged columns a whole turn remains.
constexpr double same_turn = 0.1;
/// [rad] that rows together turn, so that steps of coarse gimbals do not matter.
constexpr double far_enough = 20.0 * detail::deg;

/// Rows of a slew with one command, and the gimbal angles at both of their ends.
struct Turn {
  std::size_t before = 0, row = 0;  ///< the row at whose end it begins, and its last
  Vec3 omega_cmd_p, from, to;
  double length = 0.0;  ///< [s]
};

/// Rotation vector [rad] of the platform from the end of one row to that of another, as these
/// gimbal angles show it.
Vec3 turned(const Recording& recording, const Site& site, const Turn& t, const Vec3& from,
            const Vec3& to) {
  return rotation_vector(Mat3(attitude_shown(recording, site, t.before, from).transpose() *
                              attitude_shown(recording, site, t.row, to)));
}

std::vector<Turn> turns_of(const Recording& recording, const Timeline& timeline) {
  std::vector<Turn> all;
  bool goes_on = false;
  for (std::size_t row = 1; row < timeline.intervals.size(); ++row) {
    const Interval& i = timeline.intervals[row];
    const bool joins = std::exchange(goes_on, false);
    if (!i.slew || i.cage) continue;
    const auto from = measured(recording, gimbal_channels, row - 1),
               to = measured(recording, gimbal_channels, row);
    if (!from || !to) continue;
    const Turn own{row - 1, row, i.omega_cmd_p, *from, *to, i.length()};
    // As commanded, or as shown: commands may be wrong.
    const double shown = turned(recording, timeline.site, own, *from, *to).norm() / i.length();
    if (!(std::max(i.omega_cmd_p.norm(), shown) > fastest_drift)) continue;
    if (joins && i.omega_cmd_p == all.back().omega_cmd_p) {
      all.back().row = row;
      all.back().to = *to;
      all.back().length += i.length();
    } else {
      all.push_back(own);
    }
    goes_on = all.back().length * i.omega_cmd_p.norm() < far_enough;
  }
  return all;
}

/// Rotations of the platform as shown and as commanded.
class Slews {
 public:
  Slews(const Recording& recording, const Timeline& timeline)
      : recording_(recording), site_(timeline.site), turns_(turns_of(recording, timeline)) {}

  const std::vector<Turn>& turns() const { return turns_; }

  /// Part of the commanded turn by which the platform turned otherwise.
  double mismatch(const Turn& t, const Mixup& commands, const Mixup& gimbals, double factor = 1.0,
                  double of_angles = 1.0) const {
    const Vec3 commanded = factor * t.length * commands.of(t.omega_cmd_p);
    const Vec3 shown =
        turned(recording_, site_, t, of_angles * gimbals.of(t.from), of_angles * gimbals.of(t.to));
    const Mat3 left = rotation<double>(commanded).transpose() * rotation<double>(shown);
    return rotation_vector(left).norm() / std::min(commanded.norm(), 1.0);
  }
  /// That of the median turn: at its ends a slew may not fill a row.
  double usual_mismatch(const Mixup& commands, const Mixup& gimbals, double factor = 1.0,
                        double of_angles = 1.0) const {
    std::vector<double> all;
    for (const Turn& t : turns_) all.push_back(mismatch(t, commands, gimbals, factor, of_angles));
    return stats::upper_median(std::move(all));
  }

  /// How many turns that were otherwise are as these commands have them; none if one that was as
  /// commanded no longer is. What a slew leaves of a row at its ends no other sign puts right.
  std::size_t mended_by(const Mixup& commands) const {
    std::size_t mended = 0;
    for (const Turn& t : turns_) {
      const bool before = mismatch(t, {}, {}) < same_turn,
                 now = mismatch(t, commands, {}) < same_turn;
      if (before && !now) return 0;
      mended += !before && now;
    }
    return mended;
  }

 private:
  const Recording& recording_;
  const Site& site_;
  std::vector<Turn> turns_;
};

/// The one unit of rates in which the commands would be those that the platform obeyed.
std::optional<Unit> unit_of_commands(const Slews& slews, const Unit& said) {
  for (const Unit& unit : rate_units)
    if (slews.usual_mismatch({}, {}, unit.to_si / said.to_si) < same_turn) return unit;
  return std::nullopt;
}

/// The one unit of angles in which the gimbals would turn as commanded; of several the one that
/// leaves less than half of what any other does, and what a unit of the commands does.
std::optional<std::string_view> unit_of_gimbals(const Slews& slews, const Unit& said,
                                                const std::optional<Unit>& of_commands,
                                                const Unit& commands_said) {
  std::vector<std::pair<double, std::string_view>> left;
  if (of_commands)
    left.emplace_back(slews.usual_mismatch({}, {}, of_commands->to_si / commands_said.to_si), "");
  for (const auto& [symbol, to_si] : angle_units())
    if (to_si != said.to_si)
      left.emplace_back(slews.usual_mismatch({}, {}, 1.0, to_si / said.to_si), symbol);
  std::ranges::sort(left);
  if (left[0].second.empty() || !(left[0].first < same_turn) || left[0].first > 0.5 * left[1].first)
    return std::nullopt;
  return left[0].second;
}

/// Commands that stand rows too late or too early: with those of other rows, one or two away, the
/// platform turns as commanded in three rows or more in which it seems not to, and no longer in
/// none.
std::optional<RowMistake> shifted_commands(const Recording& recording, const Timeline& timeline) {
  const auto& all = timeline.intervals;
  const auto otherwise = [&](std::size_t row, std::size_t commanded) {
    const auto from = measured(recording, gimbal_channels, row - 1),
               to = measured(recording, gimbal_channels, row);
    if (!from || !to || all[row].cage || commanded >= all.size()) return false;
    const double length = all[row].length();
    const Vec3 command = length * all[commanded].omega_cmd_p;
    const Mat3 shown = attitude_shown(recording, timeline.site, row - 1, *from).transpose() *
                       attitude_shown(recording, timeline.site, row, *to);
    const double left = rotation_vector(Mat3(rotation<double>(command).transpose() * shown)).norm(),
                 turn = std::max(command.norm(), rotation_vector(shown).norm());
    return left > same_turn * std::min(turn, 1.0) && left > fastest_drift * length;
  };
  int shift = 0;  // rows by which they are late
  std::vector<std::size_t> most;
  for (const int late : {1, -1, 2, -2}) {
    std::vector<std::size_t> mended;
    bool broken = false;
    for (std::size_t row = 1; row < all.size() && !broken; ++row) {
      const bool before = otherwise(row, row),
                 now = otherwise(row, row + static_cast<std::size_t>(late));
      if (before && !now) mended.push_back(row);
      broken = !before && now;
    }
    if (broken || mended.size() <= most.size()) continue;
    most = mended;
    shift = late;
  }
  if (most.size() < fewest_turns) return std::nullopt;
  const std::string rows =
      fmt::format("{} row{}", std::abs(shift), std::abs(shift) == 1 ? "" : "s");
  return RowMistake{
      most.front(),
      fmt::format(
          "in slews every row turns as the command {} {} it says (expected the command of "
          "the time since the row before, and the gimbal angles at the end of it). Either "
          "cmd_x, cmd_y, cmd_z stand {} too {}, or the gimbal angles {} too {}. Correct the "
          "export",
          rows, shift > 0 ? "below" : "above", rows, shift > 0 ? "late" : "early", rows,
          shift > 0 ? "early" : "late")};
}

}  // namespace

Mat3 local_attitude_shown(const Recording& recording, std::size_t row, const Vec3& angles) {
  const Channel* heading = recording.find("case_heading");
  return case_attitude(heading ? heading->values[row] : 0.0) * gimbal_chain(angles);
}

Mat3 attitude_shown(const Recording& recording, const Site& site, std::size_t row,
                    const Vec3& angles) {
  return rotation<double>(site.omega_ie_l() * recording.find("time")->values[row]) *
         local_attitude_shown(recording, row, angles);
}

std::optional<RowMistake> slew_mistake(const Recording& recording, const Timeline& timeline,
                                       bool gimbals_as_planned) {
  const Slews slews(recording, timeline);
  const std::vector<Turn>& turns = slews.turns();
  if (turns.size() < fewest_turns) return std::nullopt;
  if (auto shifted = shifted_commands(recording, timeline)) return shifted;
  const auto wrong = [&](const Turn& t) { return !(slews.mismatch(t, {}, {}) < same_turn); };
  const auto found = std::ranges::find_if(turns, wrong);
  if (found == turns.end()) return std::nullopt;
  const std::size_t first = found->row;
  const std::string all = "in slews the platform turned as commanded";
  if (slews.usual_mismatch({}, {}) < same_turn) {
    // Most turns may be about other axes than that of the column that is wrong.
    const auto mends =
        the_one_mixup([&](const Mixup& m) { return slews.mended_by(m) >= fewest_turns; });
    if (!mends) return std::nullopt;
    return RowMistake{first, mixup_text(*mends, command_channels, all)};
  }
  const auto of_commands =
      the_one_mixup([&](const Mixup& m) { return slews.usual_mismatch(m, {}) < same_turn; });
  const auto of_gimbals = the_one_mixup([&](const Mixup& m) {
    return !gimbals_as_planned && slews.usual_mismatch({}, m) < same_turn;
  });
  if (of_commands && of_gimbals)
    return RowMistake{first, fmt::format("in slews the platform does not turn as commanded. Either "
                                         "{}. Or {}",
                                         mixup_text(*of_commands, command_channels, all),
                                         mixup_text(*of_gimbals, gimbal_channels, all))};
  if (of_commands) return RowMistake{first, mixup_text(*of_commands, command_channels, all)};
  if (of_gimbals) return RowMistake{first, mixup_text(*of_gimbals, gimbal_channels, all)};
  const Unit& said = recording.find("cmd_x")->unit;
  const auto unit = unit_of_commands(slews, said);
  const Unit& angles = recording.find("gimbal_outer")->unit;
  const bool one_unit = std::ranges::all_of(gimbal_channels.names, [&](std::string_view name) {
    return recording.find(name)->unit.to_si == angles.to_si;
  });
  if (one_unit && !gimbals_as_planned)
    if (const auto of_angles = unit_of_gimbals(slews, angles, unit, said))
      return RowMistake{
          first,
          fmt::format("gimbal_outer, gimbal_middle and gimbal_inner are in another unit: the "
                      "platform turned as commanded if the numbers are in [{}], not [{}]. "
                      "Correct the units",
                      *of_angles, angles.symbol.view())};
  if (unit)
    return RowMistake{first,
                      fmt::format("cmd_x, cmd_y, cmd_z are in another unit: the platform turned as "
                                  "if they were in [{}], not [{}]. Correct the unit",
                                  unit->symbol.view(), said.symbol.view())};
  return RowMistake{
      first, fmt::format(
                 "in {} of {} turns of slews the gimbals do not turn as commanded (expected within "
                 "{:.0f} %). Are cmd_x, cmd_y, cmd_z the rates of the platform about its axes, "
                 "and gimbal_outer, gimbal_middle, gimbal_inner its angles at the end of a row? "
                 "Correct the export",
                 std::ranges::count_if(turns, wrong), turns.size(), 100.0 * same_turn)};
}

}  // namespace drift
