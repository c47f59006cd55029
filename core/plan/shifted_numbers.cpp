#include "core/plan/shifted_numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <vector>

#include "core/plan/attitude/turn_at_change.hpp"
#include "core/plan/slew_check.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/check_time.hpp"

namespace drift {
namespace {

constexpr std::size_t fewest_positions = 3, fewest_rows = 2;

/// A new number of a caged position, and where the instruments turn.
struct Change {
  std::size_t at = 0;  ///< the first row that has it
  std::optional<SeenTurn> gimbals{}, accelerometers{};
};

bool measures(const Recording& r, const ChannelTriple& channels) {
  return std::ranges::all_of(channels.names,
                             [&](std::string_view name) { return r.find(name) != nullptr; });
}

/// Whether a row in it is of a slew.
bool commanded(const Recording& r, const SeenTurn& turn) {
  const Channel* phase = r.find("phase");
  for (std::size_t row = turn.first > 0 ? turn.first - 1 : 0; row <= turn.last; ++row) {
    if (phase != nullptr && phase->values[row] == 1.0) return true;
    const auto command = measured(r, command_channels, row);
    if (command && command->norm() > fastest_drift) return true;
  }
  return false;
}

std::vector<Change> changes_of(const Recording& r, const TestPlan* plan) {
  const auto caged = [&](double number) {
    if (plan == nullptr) return true;
    const auto k = static_cast<std::size_t>(std::max(0.0, number));
    return k >= 1 && k <= plan->positions.size() && plan->positions[k - 1].entry == Entry::caged;
  };
  const std::vector<double>& position = r.find("position")->values;
  std::vector<RowStretch> stretches;
  for (std::size_t row = 0; row < r.rows(); ++row) {
    if (row == 0 || position[row] != position[row - 1]) stretches.push_back({row, row});
    stretches.back().end = row + 1;
  }
  std::vector<Change> all;
  for (std::size_t k = 1; k < stretches.size(); ++k) {
    const RowStretch &before = stretches[k - 1], &behind = stretches[k];
    if (!caged(position[behind.first])) continue;
    Change change{.at = behind.first};
    const auto turn = [&](const ChannelTriple& channels) {
      auto seen =
          measures(r, channels) ? turn_at_change(r, channels, before, behind) : std::nullopt;
      return seen && commanded(r, *seen) ? std::nullopt : seen;
    };
    change.gimbals = turn(gimbal_channels);
    change.accelerometers = turn(accelerometer_channels);
    all.push_back(change);
  }
  return all;
}

/// By how many rows the gimbals turn behind the accelerometers, in how many positions. Where the
/// two see another part of a turn nothing tells.
std::map<std::ptrdiff_t, std::size_t> rows_behind(const std::vector<Change>& changes) {
  std::map<std::ptrdiff_t, std::size_t> all;
  for (const auto& [at, gimbals, acc] : changes) {
    if (!gimbals || !acc) continue;
    const auto begin = static_cast<std::ptrdiff_t>(gimbals->first - acc->first),
               end = static_cast<std::ptrdiff_t>(gimbals->last - acc->last);
    if (std::abs(end - begin) <= 1) ++all[begin];
  }
  return all;
}

/// Whether the numbers change while these instruments turn.
bool with_numbers(const std::vector<Change>& changes, std::optional<SeenTurn> Change::*turn) {
  return std::ranges::all_of(changes, [&](const Change& c) {
    return !(c.*turn) || ((c.*turn)->first <= c.at && c.at <= (c.*turn)->last);
  });
}

/// Whether readings are held: more rows repeat the row before than do not.
bool held(const Recording& r, const ChannelTriple& channels) {
  std::size_t repeats = 0;
  for (std::size_t row = 1; row < r.rows(); ++row)
    repeats += std::ranges::all_of(channels.names, [&](std::string_view name) {
      const auto& values = r.find(name)->values;
      return values[row] == values[row - 1];
    });
  return 2 * repeats > r.rows();
}

std::string off_columns(const Recording& r, const std::vector<Change>& changes,
                        std::ptrdiff_t behind, std::size_t positions) {
  const bool gimbals_right = with_numbers(changes, &Change::gimbals),
             acc_right = with_numbers(changes, &Change::accelerometers);
  const std::size_t rows = static_cast<std::size_t>(std::abs(behind));
  const auto columns = [&](const ChannelTriple& channels, bool late) {
    if (late && held(r, channels))
      return fmt::format(
          "columns {} hold what they read for some rows. Keep the rows alone in which they read "
          "anew",
          fmt::join(channels.names, ", "));
    return fmt::format(
        "columns {} stand {} rows {}. Move them {} rows {} in the export, and leave "
        "empty the cells of which nothing is known then",
        fmt::join(channels.names, ", "), rows, late ? "late" : "early", rows, late ? "up" : "down");
  };
  const std::string of_gimbals = columns(gimbal_channels, behind > 0),
                    of_acc = columns(accelerometer_channels, behind < 0);
  return fmt::format(
      "where the number changes from position to position the gimbals turn {} rows {} the "
      "accelerometers, in {} of them (expected readings and number of one instant in a row), and "
      "{}: {}",
      rows, behind > 0 ? "behind" : "before", positions,
      gimbals_right == acc_right ? "nothing tells which of them turn with the number"
      : acc_right                ? "the accelerometers turn with the number"
                                 : "the gimbals turn with it",
      gimbals_right == acc_right ? fmt::format("either {}. Or {}", of_gimbals, of_acc)
      : acc_right                ? of_gimbals
                                 : of_acc);
}

/// The turn as both kinds of instrument show it.
SeenTurn whole_turn(const Change& c) {
  SeenTurn turn = *c.gimbals;
  if (const auto& acc = c.accelerometers;
      acc && acc->first <= turn.last + 1 && turn.first <= acc->last + 1)
    turn = {std::min(turn.first, acc->first), std::max(turn.last, acc->last)};
  return turn;
}

/// Rows of turns at one end of positions.
struct RowsOfTurns {
  std::size_t positions = 0, most = 0;
  std::size_t first = 0, last = 0;  ///< of the first of these positions

  void take(std::size_t begin, std::size_t end) {
    if (end < begin + fewest_rows) return;
    if (positions++ == 0) {
      first = begin;
      last = end - 1;
    }
    most = std::max(most, end - begin);
  }
};

/// Rows on the way that carry the number of a position; empty where turns take one row each.
std::string turns_in_positions(const Recording& r, const std::vector<Change>& changes) {
  RowsOfTurns at_end, at_begin;
  std::size_t positions = 0;
  bool on_the_way = false;
  for (const Change& c : changes) {
    if (!c.gimbals) continue;
    const SeenTurn turn = whole_turn(c);
    const std::size_t before = at_end.positions + at_begin.positions;
    at_end.take(std::min(turn.first, c.at), c.at);
    at_begin.take(c.at, std::max(turn.last, c.at));
    if (at_end.positions + at_begin.positions == before) continue;
    ++positions;
    on_the_way = on_the_way || turn.last > turn.first;
  }
  if (!on_the_way || positions < fewest_positions) return "";
  std::vector<std::string> parts;
  const auto tell = [&](const RowsOfTurns& rows, std::string_view which, std::string_view where) {
    if (rows.positions > 0)
      parts.push_back(
          fmt::format("the {} rows of {} position{}, up to {} (lines {} to {}), show "
                      "the platform {}",
                      which, rows.positions, rows.positions == 1 ? "" : "s", rows.most,
                      line_of(r, rows.first), line_of(r, rows.last), where));
  };
  tell(at_end, "last", "in the next or on the way to it");
  tell(at_begin, "first", "in the one before or on the way from it");
  return fmt::format(
      "{} (expected rows of a position alone). Let the positions be counted from "
      "turn to turn, [recording] ignore = [\"position\"], or write 0 as the number "
      "of these rows",
      fmt::join(parts, ", and "));
}

/// Numbers that change where the platform stands, before or behind its jump.
std::string late_or_early(const std::vector<Change>& changes) {
  std::map<std::size_t, std::size_t> late, early;  // rows, in how many positions
  std::size_t stays = 0;  // positions behind which it does not jump where the number changes
  for (const Change& c : changes) {
    if (!c.gimbals) continue;
    if (c.gimbals->first < c.at) {
      ++late[c.at - c.gimbals->first];
      if (c.gimbals->last < c.at) ++stays;
    } else if (c.gimbals->last > c.at) {
      ++early[c.gimbals->last - c.at];
    }
  }
  const auto one = [](const auto& counts) {
    return counts.size() == 1 && counts.begin()->first >= fewest_rows &&
           counts.begin()->second >= fewest_positions;
  };
  std::size_t turned = 0;  // positions in whose end it turns, two rows or more before the number
  for (const auto& [rows, positions] : late)
    if (rows >= fewest_rows) turned += positions;
  const bool all_stay = turned > 0 && stays == turned && late.begin()->first >= fewest_rows;
  if (!one(late) && early.empty() && (turned >= fewest_positions || all_stay))
    return fmt::format(
        "the last rows of {} position{}, up to {}, show the platform in the next or on the way to "
        "it (expected rows of a position alone). Write 0 as their number, leave them out, or let "
        "the number change so much earlier",
        turned, turned == 1 ? "" : "s", late.rbegin()->first);
  const bool is_late = one(late) && early.empty(), is_early = one(early) && late.empty();
  if (!is_late && !is_early) return "";
  const auto& [rows, positions] = is_late ? *late.begin() : *early.begin();
  return fmt::format(
      "the {} {} rows of {} positions show the attitude of the {}: the numbers of the positions "
      "change {} rows too {} (expected with the platform). Let them change so many rows {}, or "
      "leave these rows out",
      is_late ? "last" : "first", rows, positions, is_late ? "next" : "one before", rows,
      is_late ? "late" : "early", is_late ? "earlier" : "later");
}

std::string shifted(const Recording& r, const TestPlan* plan) {
  if (r.find("position") == nullptr || !measures(r, gimbal_channels)) return "";
  const std::vector<Change> changes = changes_of(r, plan);
  const auto behind = rows_behind(changes);
  std::size_t apart = 0;  // positions in which the instruments turn rows from each other
  for (const auto& [rows, positions] : behind)
    if (std::abs(rows) >= static_cast<std::ptrdiff_t>(fewest_rows)) apart += positions;
  std::string text;
  if (apart == 0) {
    text = turns_in_positions(r, changes);
    if (text.empty()) text = late_or_early(changes);
  } else if (behind.size() == 1 && apart >= fewest_positions) {
    text = off_columns(r, changes, behind.begin()->first, apart);
  }
  return text.empty() ? "" : fmt::format("{}: {}", r.source.empty() ? "recording" : r.source, text);
}

}  // namespace

std::string shifted_numbers(const Recording& r, const TestPlan& plan) {
  return shifted(r, &plan);
}

std::string shifted_numbers(const Recording& r) {
  return shifted(r, nullptr);
}

}  // namespace drift
