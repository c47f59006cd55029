#include "core/plan/attitude_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "core/physics/gimbals.hpp"
#include "core/plan/attitude/early_rows.hpp"
#include "core/plan/attitude/rotation_order.hpp"
#include "core/plan/attitude_slips.hpp"
#include "core/plan/case_heading.hpp"
#include "core/plan/late_rows.hpp"
#include "core/plan/mixup.hpp"
#include "core/plan/other_order.hpp"
#include "core/plan/slew_check.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

double of_accelerometers(const Sight& s, const Vec3& seen) {
  const Vec3 expected = s.R_lr.row(2);
  return std::atan2(seen.cross(expected).norm(), seen.dot(expected));
}

double of_gimbals(const Sight& s, const Vec3& seen) {
  Sight other = s;
  other.seen = seen;
  return gimbal_mismatch(other);
}

/// The mixup that brings every sight into place.
std::optional<Mixup> mixup_behind(const std::vector<Sight>& sights, Mismatch mismatch,
                                  double most) {
  if (sights.size() < fewest_sights) return std::nullopt;
  return the_one_mixup([&](const Mixup& m) {
    return std::ranges::all_of(sights,
                               [&](const Sight& s) { return mismatch(s, m.of(s.seen)) < most; });
  });
}

std::string first_rows_text(std::size_t positions, std::string_view reason) {
  return fmt::format(
      "the first row of {} positions still shows the attitude before, the second row that of the "
      "plan: {} (expected readings and number of one instant in a row). Correct the export",
      positions, reason);
}

std::optional<std::string> late_text(const std::vector<std::size_t>& late,
                                     const ChannelTriple& channels, std::size_t positions) {
  if (late.empty()) return std::nullopt;
  std::vector<std::string_view> names;
  for (const std::size_t i : late) names.push_back(channels.names[i]);
  const bool one = names.size() == 1;
  return first_rows_text(positions, fmt::format("column{} {} stand{} a row late", one ? "" : "s",
                                                fmt::join(names, ", "), one ? "s" : ""));
}

/// All positions that are elsewhere, in one message.
std::string elsewhere_text(const TestPlan& plan, const std::vector<Sight>& wrong, std::size_t all,
                           Mismatch mismatch, const char* what, const std::string& advice) {
  constexpr std::size_t most = 4;
  std::vector<std::string> places;
  for (const Sight& s : wrong)
    if (places.size() < most)
      places.push_back(fmt::format("position {} ('{}') {:.0f} deg", s.position + 1,
                                   plan.positions[static_cast<std::size_t>(s.position)].name,
                                   mismatch(s, s.seen) / detail::deg));
  return fmt::format(
      "in {} of {} positions the {} away from the attitude in the plan (expected at most {:.0f} "
      "deg): {}{}. {}",
      wrong.size(), all, what, largest_mismatch / detail::deg, fmt::join(places, ", "),
      wrong.size() > most ? fmt::format(" and {} more", wrong.size() - most) : "", advice);
}

/// What one kind of instrument shows: where it is elsewhere, and why, if something simple explains
/// all of it.
struct Shown {
  std::vector<Sight> sights, wrong;
  std::optional<std::string> reason;
  bool mixed_up = false;  ///< columns exchanged or reversed are the reason
};

Shown shown_by(const Recording& recording, std::vector<Sight> sights, const ChannelTriple& channels,
               Mismatch mismatch, double most) {
  Shown shown{.sights = std::move(sights), .wrong = {}, .reason = {}};
  for (const Sight& s : shown.sights)
    if (!(mismatch(s, s.seen) < most)) shown.wrong.push_back(s);
  if (shown.wrong.empty()) return shown;
  const auto mixup = mixup_behind(shown.sights, mismatch, most);
  shown.mixed_up = mixup.has_value();
  if (mixup)
    shown.reason = mixup_text(
        *mixup, channels,
        fmt::format("all {} positions have the attitude of the plan", shown.sights.size()));
  else
    shown.reason = late_text(late_columns(recording, shown.wrong, channels, mismatch), channels,
                             shown.wrong.size());
  return shown;
}

/// What accelerometers show, expected at the attitudes that the gimbals show.
std::vector<Sight> where_gimbals_are(const std::vector<Sight>& accelerometers,
                                     const std::vector<Sight>& gimbals) {
  std::vector<Sight> all;
  for (const Sight& g : gimbals) {
    const auto a = std::ranges::find(accelerometers, g.row, &Sight::row);
    if (a == accelerometers.end()) continue;
    all.push_back(*a);
    all.back().R_lr = case_attitude(g.heading) * gimbal_chain(g.seen);
  }
  return all;
}

/// Whether both kinds of instrument show the same Up in every position, whatever the plan says.
bool agree(const std::vector<Sight>& accelerometers, const std::vector<Sight>& gimbals) {
  return std::ranges::all_of(where_gimbals_are(accelerometers, gimbals), [](const Sight& s) {
    return of_accelerometers(s, s.seen) < largest_mismatch;
  });
}

/// Positions whose first rows are not theirs, if that is all that is wrong: three or more, or as
/// both kinds of instrument show. Behind rows that were left out one alone may have measured.
std::optional<RowMistake> rows_of_others(const Recording& recording, const Shown& acc,
                                         const Shown& gimbals) {
  std::size_t rows = 0, positions = 0, first = recording.rows();
  for (const Shown* shown : {&acc, &gimbals}) {
    if (shown->wrong.empty()) continue;
    const bool of_acc = shown == &acc;
    const std::size_t own =
        rows_on_the_way(recording, shown->wrong, of_acc ? accelerometer_channels : gimbal_channels,
                        of_acc ? of_accelerometers : of_gimbals);
    if (own == 0 || shown->reason) return std::nullopt;
    rows = std::max(rows, own);
    positions = std::max(positions, shown->wrong.size());
    first = std::min(first, shown->wrong.front().row);
  }
  const bool both = !acc.wrong.empty() && !gimbals.wrong.empty();
  if (positions < (both ? 1 : fewest_sights)) return std::nullopt;
  return RowMistake{
      first,
      fmt::format("the first rows of {} position{}, up to {}, show another attitude than those "
                  "behind them, which show that of the plan: rows on the way, or of the "
                  "position before (expected rows of a position alone). Write 0 as their "
                  "number, leave them out, or let the number change so much later",
                  positions, positions == 1 ? "" : "s", rows)};
}

/// Drift and another latitude bend the way of a platform that is slewed, by half of what parts two
/// axes at most [rad].
constexpr double on_the_way = 45.0 * detail::deg;

/// Rows at which an attitude is looked at: where the platform is caged, or where a dwell begins.
enum class Rows { caged, dwelling };

std::vector<Sight> sights_of(const Recording& recording, const TestPlan& plan,
                             const Timeline& timeline, const ChannelTriple& channels, Rows rows) {
  std::vector<Sight> all;
  const std::vector<Passage> passages = plan_passages(plan, timeline.site);
  for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
    const Interval& i = timeline.intervals[k];
    const Interval* before = k > 0 ? &timeline.intervals[k - 1] : nullptr;
    const bool dwells = !i.slew && (!before || before->slew || before->position != i.position);
    // A recording may begin on the way: the mean of a slew is no attitude.
    if (rows == Rows::caged ? !i.cage || i.slew : !dwells) continue;
    if (const auto seen = measured(recording, channels, k))
      all.push_back({k, i.position, i.heading1,
                     passages[static_cast<std::size_t>(i.position)].dwell.heading1,
                     timeline.nodes[i.last_node()].R_lr, *seen});
  }
  return all;
}

/// Sights at the attitudes of the plan itself, whatever the commands say.
std::vector<Sight> as_planned(std::vector<Sight> sights, const TestPlan& plan) {
  for (Sight& s : sights) s.R_lr = plan.positions[static_cast<std::size_t>(s.position)].R_lp;
  return sights;
}

/// What to do where an instrument shows other attitudes than the plan has, by those of its other
/// positions.
std::string advice_for(const Recording& recording, const TestPlan& plan, const Site& site,
                       const std::vector<Sight>& sights, Mismatch mismatch) {
  const std::vector<Passage> passages = plan_passages(plan, site);
  const bool headings = recording.find("case_heading") != nullptr;
  const auto at = [&](Sight s, std::size_t p) {
    s.R_lr = plan.positions[p].R_lp;
    if (!headings) s.heading = passages[p].dwell.heading1;
    return mismatch(s, s.seen);
  };
  const auto& numbers = recording.find("position")->values;
  return other_order_advice(
      shown_positions(sights, passages.size(), at),
      sights.size() == std::set<double>(numbers.begin(), numbers.end()).size());
}

AngleUnits units_of(const Recording& recording) {
  AngleUnits units;
  units.fill(unit::rad);
  std::size_t i = 0;
  for (const std::string_view name : {gimbal_channels.names[0], gimbal_channels.names[1],
                                      gimbal_channels.names[2], std::string_view("case_heading")}) {
    if (const Channel* c = recording.find(name)) units[i] = c->unit;
    ++i;
  }
  return units;
}

}  // namespace

std::vector<RowMistake> attitude_mistakes(const Recording& recording, const TestPlan& plan,
                                          const Timeline& timeline) {
  const auto sights = [&](const ChannelTriple& channels, Rows rows) {
    return sights_of(recording, plan, timeline, channels, rows);
  };
  const auto shown = [&](std::vector<Sight> seen, const ChannelTriple& channels, Mismatch mismatch,
                         double most) {
    return shown_by(recording, std::move(seen), channels, mismatch, most);
  };
  const auto caged = [&](const ChannelTriple& channels, Mismatch mismatch) {
    return shown(sights(channels, Rows::caged), channels, mismatch, largest_mismatch);
  };
  Shown acc = caged(accelerometer_channels, of_accelerometers);
  Shown gimbals = caged(gimbal_channels, of_gimbals);
  if (std::max(acc.sights.size(), gimbals.sights.size()) < fewest_sights) {
    // Slewed from position to position. Drift bends the way, not the slews; and accelerometers show
    // Up where gimbals that are right have it.
    const std::vector<Sight> by_gimbals = sights(gimbal_channels, Rows::dwelling),
                             by_acc = sights(accelerometer_channels, Rows::dwelling);
    Shown on_way = shown(as_planned(by_gimbals, plan), gimbal_channels, of_gimbals, on_the_way);
    if (const auto slews = slew_mistake(recording, timeline, on_way.wrong.empty())) return {*slews};
    const bool right = on_way.wrong.empty() && !by_gimbals.empty();
    Shown up = right ? shown(where_gimbals_are(by_acc, by_gimbals), accelerometer_channels,
                             of_accelerometers, largest_mismatch)
                     : shown(as_planned(by_acc, plan), accelerometer_channels, of_accelerometers,
                             on_the_way);
    if (up.mixed_up || (!right && up.sights.size() > acc.sights.size())) acc = std::move(up);
    if (!right && on_way.sights.size() > gimbals.sights.size()) gimbals = std::move(on_way);
  }
  if (numbers_early(recording, acc.wrong, accelerometer_channels, of_accelerometers) &&
      numbers_early(recording, gimbals.wrong, gimbal_channels, of_gimbals) &&
      agree(acc.sights, gimbals.sights))
    return {
        {gimbals.wrong.front().row,
         first_rows_text(gimbals.wrong.size(), "the numbers of the positions change a row early")}};
  if (auto way = rows_of_others(recording, acc, gimbals)) return {*way};
  if (!gimbals.wrong.empty() && !gimbals.reason) {
    auto slip = slip_behind(gimbals.sights, units_of(recording));
    if (!slip && acc.wrong.empty() && !acc.sights.empty())
      slip = rotation_order_behind(gimbals.sights);
    if (slip)
      gimbals.reason = fmt::format(
          "in {} of {} positions the gimbal angles do not show the attitude of the plan (expected "
          "within {:.0f} deg); all would if this were so: {}",
          gimbals.wrong.size(), gimbals.sights.size(), largest_mismatch / detail::deg, *slip);
  }
  const auto elsewhere = [&](const Shown& s, Mismatch mismatch, const char* what) {
    return elsewhere_text(plan, s.wrong, s.sights.size(), mismatch, what,
                          advice_for(recording, plan, timeline.site, s.sights, mismatch));
  };
  const bool few = 2 * gimbals.wrong.size() < gimbals.sights.size() && acc.wrong.empty();
  const std::string another_unit = few ? unit_there(gimbals.wrong, units_of(recording)) : "";
  std::vector<RowMistake> all;
  // Two instruments that agree with each other are right: what is wrong is the plan.
  if (!acc.wrong.empty() && !gimbals.wrong.empty() && !(acc.reason && gimbals.reason) &&
      agree(acc.sights, gimbals.sights))
    return {{gimbals.wrong.front().row,
             elsewhere(gimbals, of_gimbals,
                       "accelerometers and the gimbal angles agree with each other and are")}};
  if (!acc.wrong.empty())
    all.push_back({acc.wrong.front().row, acc.reason.value_or(elsewhere(
                                              acc, of_accelerometers, "accelerometers show Up"))});
  if (!gimbals.wrong.empty())
    all.push_back({gimbals.wrong.front().row,
                   gimbals.reason.value_or(elsewhere(gimbals, of_gimbals, "gimbal angles are") +
                                           another_unit)});
  if (acc.wrong.empty() && gimbals.wrong.empty())
    if (auto early = early_columns(recording, timeline)) all.push_back(std::move(*early));
  if (gimbals.wrong.empty())
    if (auto beyond = middle_beyond_a_turn(gimbals.sights, units_of(recording)))
      all.push_back(std::move(*beyond));
  std::ranges::stable_sort(all, {}, &RowMistake::row);
  return all;
}

}  // namespace drift
