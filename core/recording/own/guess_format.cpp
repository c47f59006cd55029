#include "core/recording/own/guess_format.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/guess_position.hpp"
#include "core/recording/own/guess_values.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/sexagesimal.hpp"

namespace drift {
namespace {

bool has(const GuessedFile& file, std::string_view start) {
  return std::ranges::any_of(file.columns, [&](const GuessedColumn& c) {
    return !c.by_values && c.channel.starts_with(start);
  });
}

/// Times that are counted since 1970 tell their unit by their size; others do not.
std::string unit_of_epoch(const GuessedColumn& c) {
  constexpr std::pair<double, std::string_view> sizes[] = {
      {1.0, "s"}, {1e3, "ms"}, {1e6, "us"}, {1e9, "ns"}};
  constexpr double early = 1e9, late = 4e9;  // [s] 2001 to 2096
  for (const auto& [size, unit] : sizes)
    if (c.numbers > 0 && c.low > early * size && c.high < late * size) return std::string(unit);
  return "?";
}

/// A temperature that nothing survives, and that is one in kelvins.
bool is_in_kelvins(const GuessedColumn& c, const Unit& stated) {
  if (c.channel != "temperature" || stated.dim != "K"_unit.dim || celsius_offset(stated) != 0.0)
    return false;
  const double most = known_quantity(c.channel)->most, zero = celsius_offset("K"_unit);
  return c.low > 0.0 && c.high > most && c.high + zero <= most;
}

/// A temperature that is none in kelvins, as nothing is so cold, and one in degC.
bool is_in_celsius(const GuessedColumn& c, const Unit& stated) {
  if (c.channel != "temperature" || !same_unit(stated, "K"_unit)) return false;
  const double most = known_quantity(c.channel)->most;
  return c.low + celsius_offset(stated) < -most && c.low >= -most && c.high <= most;
}

/// The unit that a temperature is in by its values, whatever is written; else what is written.
std::string by_size(const GuessedColumn& c, const Unit& stated, const std::string& written) {
  return is_in_kelvins(c, stated) ? "K" : is_in_celsius(c, stated) ? "degC" : written;
}

/// Whether the first text stands in fewer rows than a position has, as no other does: a remark
/// before the first position. The last one may be cut short.
bool begins_with_remark(const GuessedColumn& c) {
  const auto few = [](std::size_t rows) { return rows < PositionLimits::fewest_rows; };
  return c.text_rows.size() > 2 && few(c.text_rows.front()) &&
         std::none_of(c.text_rows.begin() + 1, c.text_rows.end() - 1, few);
}

/// Whether a text in the column of positions says that it is turned: the only one that comes back,
/// the only one beside numbers, or a remark before all others. One that is the first may be a
/// position to return to.
bool is_turned(const GuessedColumn& c, const std::string& word) {
  const auto is_text = [](const std::string& w) { return std::isnan(cell_number(w)); };
  if (c.numbers == 0 && c.words.front() == word && begins_with_remark(c)) return true;
  if (c.again.empty())
    return c.numbers > 0 && is_text(word) && std::ranges::count_if(c.words, is_text) == 1;
  return c.again.size() == 1 && c.again.contains(word) && c.words.front() != word;
}

}  // namespace

std::string guessed_unit_of(const GuessedColumn& c, const std::string& gravity) {
  const auto quantity = known_quantity(c.channel);
  if (!quantity || !quantity->needs_unit) return {};
  // Times of a clock.
  if (c.channel == "time" && (c.needs_date || (c.numbers == 0 && c.texts > 0))) return {};
  if (c.header.unit)
    if (const auto unit = parse_recording_unit(*c.header.unit))
      return by_size(c, *unit, *c.header.unit);
  if (const std::string ending = guessed_unit(c.header.name); !ending.empty())
    if (const auto unit = parse_recording_unit(ending); unit && measures(*unit, c.channel))
      return by_size(c, *unit, ending);
  if (c.channel.starts_with("acc_")) return gravity;
  if (c.channel.starts_with("gyro_") && c.header.name.starts_with("field.")) return "rad/s";  // ROS
  if (c.channel == "time") return unit_of_epoch(c);
  constexpr double full_turn = 7.0;  // [rad] no angle is larger
  const bool heading = c.channel == "case_heading";
  const bool in_degrees = std::max(-c.low, c.high) > full_turn ||
                          (!c.words.empty() && angle_in_minutes_and_seconds(c.words.front()));
  if (is_angle(c.channel) && in_degrees) return "deg";
  if (heading && c.low == 0.0 && c.high == 0.0) return "deg";  // North in every unit
  return c.channel == "temperature" ? "" : "?";                // a covariate does without
}

void leave_out_nines(GuessedFile& file) {
  constexpr double farther = 10.0;
  const auto may_lack = [&](const GuessedColumn& c) {
    return c.channel != "time" && c.channel != "position" && c.header.name != file.format.counter &&
           c.header.name != file.counter;
  };
  const auto far = [&](const GuessedColumn& c) {
    const double others = std::max(-c.low_beside, c.high_beside);
    return !c.nines.empty() && c.low_beside <= c.high_beside &&
           std::ranges::all_of(c.nines, [&](const std::string& cell) {
             return std::abs(cell_number(cell)) > farther * others;
           });
  };
  // What stands for nothing in one column may be a reading of another.
  const auto is_read = [&](double number) {
    return std::ranges::any_of(file.columns, [&](const GuessedColumn& c) {
      return may_lack(c) && !far(c) &&
             std::ranges::find(c.nines, number, cell_number) != c.nines.end();
    });
  };
  for (GuessedColumn& c : file.columns) {
    if (!may_lack(c) || !far(c) || std::ranges::any_of(c.nines, is_read, cell_number)) continue;
    c.low = c.low_beside;
    c.high = c.high_beside;
    for (const std::string& cell : c.nines)
      if (const std::string number = fmt::format("{}", cell_number(cell));
          std::ranges::find(file.format.missing, number) == file.format.missing.end())
        file.format.missing.push_back(number);
  }
}

std::string own_name(const GuessedColumn& c) {
  const auto in_file = c.header.unit ? parse_recording_unit(*c.header.unit) : std::nullopt,
             meant = parse_recording_unit(c.unit);
  return in_file && meant && !same_unit(*in_file, *meant)
             ? fmt::format("{} [{}]", c.header.name, *c.header.unit)
             : c.header.name;
}

void fill_format(GuessedFile& file) {
  file.complete = file.counter.empty();
  for (const GuessedColumn& c : file.columns) {
    if (c.channel.empty() || c.unit == "?") {
      file.complete = file.complete && c.unit != "?";
      continue;
    }
    MappedColumn m{c.channel, own_name(c), {}, 1.0};
    if (!c.unit.empty()) m.unit = c.unit;
    if (c.channel != m.own || (!c.unit.empty() && !c.header.unit)) file.format.columns.push_back(m);
    int number = 0;
    for (const std::string& word : c.words)
      if (c.channel == "position")
        file.format.positions.emplace_back(word, is_turned(c, word) ? 0 : ++number);
  }
  if (!file.format.header.empty() && file.format.columns.empty()) file.complete = false;
}

void take_as(GuessedFile& file, RecordingKind kind) {
  file.kind = kind;
  const auto known = canonical_channels(kind);
  for (GuessedColumn& c : file.columns)
    if (std::ranges::find(known, c.channel) == known.end()) {
      c.channel.clear();
      c.unit.clear();
    }
  file.format.columns.clear();
  file.format.positions.clear();
  fill_format(file);
}

std::string other_kind(const GuessedFile& file, RecordingKind kind) {
  const bool on_case = kind == RecordingKind::strapdown;
  const std::string_view theirs = on_case ? "gimbal_" : "gyro_";
  if (!has(file, theirs) || has(file, on_case ? "gyro_" : "gimbal_") ||
      (!on_case && has(file, "position")))
    return "";
  std::vector<std::string> names;
  for (const GuessedColumn& c : file.columns)
    if (c.channel.starts_with(theirs)) names.push_back(in_quotes(c.header.whole));
  return fmt::format("{} {}, and no column {}", fmt::join(names, ", "),
                     on_case ? "are gimbal angles" : "are gyros on a case",
                     on_case ? "is a gyro" : "is a gimbal angle or the number of a position");
}

}  // namespace drift
