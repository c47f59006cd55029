#include "core/recording/own/guess_position.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/recording/own/clock.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/like_temperature.hpp"

namespace drift {
namespace {

bool has_no_unit(const HeaderCell& cell) {
  return guessed_unit(cell.name).empty() &&
         (!cell.unit || cell.unit->empty() || *cell.unit == "1" || *cell.unit == "-");
}

/// Columns whose channels begin so, and what is a turn of them.
struct Instruments {
  std::vector<std::size_t> columns;
  double turn = 0.0;

  Instruments(const GuessedFile& file, std::string_view start) {
    for (std::size_t i = 0; i < file.columns.size(); ++i) {
      const GuessedColumn& c = file.columns[i];
      if (!c.channel.starts_with(start)) continue;
      columns.push_back(i);
      turn = std::max(turn, PositionLimits::turn * (c.high - c.low));
    }
  }
  bool apart(const std::vector<double>& a, const std::vector<double>& b) const {
    return std::ranges::any_of(columns,
                               [&](std::size_t i) { return std::abs(a[i] - b[i]) > turn; });
  }
};

}  // namespace

GuessPosition::GuessPosition(const GuessedFile& file) {
  if (file.kind != RecordingKind::platform) return;
  const auto called = std::ranges::find(file.columns, "position", &GuessedColumn::channel);
  named_ = called != file.columns.end();
  if (named_) {
    candidates_.push_back({.column = static_cast<std::size_t>(called - file.columns.begin()),
                           .stretches = {},
                           .labels = {}});
    return;
  }
  for (std::size_t i = 0; i < file.columns.size(); ++i)
    if (const GuessedColumn& c = file.columns[i];
        c.channel.empty() && has_no_unit(c.header) && !looks_like_temperature(c.header) &&
        c.header.name != file.counter && c.header.name != file.format.counter)
      candidates_.push_back({.column = i, .stretches = {}, .labels = {}});
}

/// Begins a stretch behind the last one; false if the label cannot be that of a position.
bool GuessPosition::begin(Candidate& candidate, std::string_view label) {
  const double number = cell_number(label);
  if (is_date(label) || !(number == std::round(number)) || !candidate.labels.insert(number).second)
    return false;
  auto& all = candidate.stretches;
  if (!all.empty() && all.back().rows < PositionLimits::fewest_rows) return false;
  all.push_back({std::string(label), 0, {}, {}});
  return all.size() <= PositionLimits::most_changes + 1;
}

/// A text, nothing and -1 may say that it is turned; so does 0, unless the first position alone is
/// called so.
bool GuessPosition::says_turned(Candidate& candidate, double number) {
  if (!(number >= 0.0)) return true;
  auto& all = candidate.stretches;
  if (all.empty()) return false;
  const bool from_zero = cell_number(all.front().label) == 0.0,
             alone = from_zero && all.size() == 1;
  if (number == 0.0 && alone && !candidate.turned) return false;
  if (number > 0.0 && !(alone && all.front().rows < PositionLimits::fewest_rows)) return false;
  if (from_zero) {
    all.erase(all.begin());
    candidate.labels.erase(0.0);
  }
  return number == 0.0;
}

void GuessPosition::look_at_row(const std::vector<std::string_view>& cells) {
  for (Candidate& c : candidates_) {
    if (!c.may_be) continue;
    const std::string_view label = cells[c.column];
    if (named_ && says_turned(c, cell_number(label))) {
      c.turned = true;
      continue;
    }
    if (std::exchange(c.turned, false) || c.stretches.empty() || c.stretches.back().label != label)
      c.may_be = begin(c, label);
    if (!c.may_be) {
      c.stretches = {};
      continue;
    }
    Stretch& s = c.stretches.back();
    // At every power of two: the last but one lies between a quarter and a half of the stretch.
    if (!std::has_single_bit(++s.rows)) continue;
    s.early = std::move(s.late);
    s.late.clear();
    for (const auto cell : cells) s.late.push_back(cell_number(cell));
  }
}

bool GuessPosition::is_position(const Candidate& candidate, const GuessedFile& file) {
  const auto& all = candidate.stretches;
  if (!candidate.may_be || all.size() <= PositionLimits::fewest_changes ||
      all.back().rows < PositionLimits::fewest_rows)
    return false;
  const Instruments acc(file, "acc_"), gimbals(file, "gimbal_");
  const Instruments& held = acc.columns.empty() ? gimbals : acc;
  if (held.columns.empty() ||
      std::ranges::any_of(all, [&](const Stretch& s) { return held.apart(s.early, s.late); }))
    return false;
  std::size_t turns = 0;
  for (std::size_t k = 1; k < all.size(); ++k)
    if (acc.apart(all[k - 1].late, all[k].late) || gimbals.apart(all[k - 1].late, all[k].late))
      ++turns;
  return 2 * turns >= all.size() - 1;
}

std::vector<std::string> GuessPosition::own_labels(const Candidate& candidate) {
  bool counted = true;
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < candidate.stretches.size(); ++k) {
    const std::string& label = candidate.stretches[k].label;
    counted = counted && cell_number(label) == static_cast<double>(k + 1);
    labels.push_back(label);
  }
  return counted ? std::vector<std::string>() : labels;
}

void GuessPosition::name_channel(GuessedFile& file) const {
  if (named_) {
    // From 0 on, or with more left out than held (10, 20, 30): no plan is numbered so. Other
    // numbers that increase may be a part of the plan's.
    const Candidate& c = candidates_.front();
    const auto rows = [](const Stretch& s) { return s.rows >= PositionLimits::fewest_rows; };
    if (!c.may_be || c.stretches.size() < 2 || !std::ranges::all_of(c.stretches, rows)) return;
    const double most = PositionLimits::most_left_out * static_cast<double>(c.labels.size());
    std::vector<std::string> labels = own_labels(c);
    if (labels.size() > PositionLimits::most_labels) return;
    const bool of_no_plan = *c.labels.begin() < 1.0 || *c.labels.rbegin() > most;
    GuessedColumn& column = file.columns[c.column];
    if (of_no_plan) {  // a text beside them says that it is turned
      std::ranges::copy(column.words, std::back_inserter(labels));
      column.words = std::move(labels);
    } else {
      column.numbered = std::move(labels);
    }
    return;
  }
  std::vector<const Candidate*> found;
  for (const Candidate& c : candidates_)
    if (file.columns[c.column].channel.empty() && is_position(c, file)) found.push_back(&c);
  if (found.size() != 1) return;
  std::vector<std::string> labels = own_labels(*found.front());
  if (labels.size() > PositionLimits::most_labels) return;
  GuessedColumn& column = file.columns[found.front()->column];
  column.channel = "position";
  column.by_values = true;
  if (!labels.empty()) column.words = std::move(labels);
}

}  // namespace drift
