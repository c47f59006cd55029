#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/base/words.hpp"
#include "core/config/node.hpp"
#include "core/recording/own/guess.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

std::string quoted(const std::string& text) {
  return config::to_toml(config::text_node(text));
}

std::string duration_text(double seconds) {
  return seconds >= 1.0    ? fmt::format("{:g} s", seconds)
         : seconds >= 1e-3 ? fmt::format("{:g} ms", 1e3 * seconds)
                           : fmt::format("{:g} us", 1e6 * seconds);
}

/// The unit that a column has, by its header or by the ending of its name; empty if that is none.
std::string unit_in_file(const GuessedColumn& c) {
  if (c.header.unit) return parse_recording_unit(*c.header.unit) ? *c.header.unit : "";
  const std::string ending = guessed_unit(c.header.name);
  return parse_recording_unit(ending) ? ending : "";
}

/// What is to be checked of columns whose names said nothing, as a comment.
std::string guessed_by_values(const GuessedFile& file) {
  const auto by_values = [&](std::string_view channel) {
    return std::ranges::any_of(
        file.columns, [&](const GuessedColumn& c) { return c.by_values && c.channel == channel; });
  };
  std::string text;
  if (by_values("acc_x")) text = "acc_x, acc_y, acc_z are in the order of the columns: check";
  std::set<std::string> units;
  for (const GuessedColumn& c : file.columns)
    if (c.channel.starts_with("acc_")) units.insert(c.unit);
  if (units.size() > 1 && !units.contains("?"))
    for (const GuessedColumn& c : file.columns)
      if (c.channel.starts_with("acc_") && !c.header.unit)
        text += fmt::format("{}{} in [{}] by its size: check", text.empty() ? "" : "; ", c.channel,
                            c.unit);
  for (const GuessedColumn& c : file.columns)
    if (c.channel == gimbal_channels.names[0] && c.unit != "?" && c.unit != "deg" &&
        unit_in_file(c).empty())
      text += fmt::format(
          "{}the gimbal angles in [{}], where they have Up as the accelerometers "
          "have it: check",
          text.empty() ? "" : "; ", c.unit);
  if (by_values("case_heading"))
    text += fmt::format("{}case_heading by its values: check", text.empty() ? "" : "; ");
  for (const GuessedColumn& c : file.columns)
    if (c.by_values && c.channel == "position")
      text += fmt::format("{}position by its {}: check", text.empty() ? "" : "; ",
                          c.numbers > 0 ? "numbers, which change as the attitude does" : "texts");
  for (const auto& [word, number] : file.format.positions)
    if (number == 0)
      text += fmt::format("{}positions: it is turned where {} stands: check",
                          text.empty() ? "" : "; ", in_quotes(word));
  for (const GuessedColumn& c : file.columns)
    if (c.channel == "temperature" && own_name(c) != c.header.name)
      text += fmt::format("{}temperature in [{}] by its values: check", text.empty() ? "" : "; ",
                          c.unit);
  return text.empty() ? "" : "  # " + text;
}

/// A column as the study file may name it: "Winkel A [rad]".
std::string with_unit(const GuessedColumn& c) {
  const std::string unit = unit_in_file(c);
  return unit.empty() ? c.header.name : fmt::format("{} [{}]", c.header.name, unit);
}

/// Columns of numbers that are no channel.
std::vector<const GuessedColumn*> free_columns(const GuessedFile& file) {
  std::vector<const GuessedColumn*> free;
  for (const GuessedColumn& c : file.columns)
    if (c.channel.empty() && c.numbers > 0 && !c.header.name.empty() &&
        !known_quantity(c.header.name) && c.header.name != file.format.counter &&
        c.header.name != file.counter && c.header.name != file.format.date)
      free.push_back(&c);
  return free;
}

/// Those of them that have a unit in which a channel is measured.
std::vector<std::string> in_units_of(const GuessedFile& file, std::string_view channel) {
  std::vector<std::string> names;
  for (const GuessedColumn* c : free_columns(file)) {
    const auto unit = parse_recording_unit(unit_in_file(*c));
    if (unit && (unit->dim == known_quantity(channel)->unit.dim ||
                 (channel.starts_with("acc_") && unit->dim == "m/s^2"_unit.dim)))
      names.push_back(with_unit(*c));
  }
  return names;
}

}  // namespace

bool needs_section(const GuessedFile& file) {
  const RecordingFormat& f = file.format;
  return !f.columns.empty() || !f.positions.empty() || !f.missing.empty() || !f.date.empty() ||
         !f.counter.empty() || f.angles != AngleDigits::automatic;
}

std::string recording_section(const GuessedFile& file) {
  std::string columns, positions;  // TOML keeps an inline table on one line
  for (const GuessedColumn& c : file.columns)
    if (!c.channel.empty())
      columns += fmt::format(
          "{}{} = {}", columns.empty() ? "" : ", ", c.channel,
          quoted(c.unit.empty() ? own_name(c) : fmt::format("{} [{}]", own_name(c), c.unit)));
  const RecordingFormat& f = file.format;
  std::string out = "[recording]\n", header;
  for (const std::string& name : f.header)
    header += fmt::format("{}{}", header.empty() ? "" : ", ", quoted(name));
  if (!header.empty())
    out += fmt::format("header  = [{}]  # name them and say below what they are\n", header);
  if (f.delimiter == Delimiter::comma) out += "delimiter = \",\"\n";
  out += !file.format.positions.empty() && columns.empty() ? ""
         : columns.empty()
             ? "# columns = { time = \"column_1 [s]\", gyro_x = \"column_2 [rad/s]\" }\n"
             : fmt::format("columns = {{ {} }}{}\n", columns, guessed_by_values(file));
  if (f.angles != AngleDigits::automatic)
    out += fmt::format("angles  = {}  # by their digits: check\n",
                       quoted(std::string(name_in(angle_digits, f.angles))));
  if (!f.missing.empty())
    out += fmt::format("missing = [{}]  # far from all other numbers: check\n",
                       fmt::join(f.missing, ", "));
  if (!f.date.empty()) out += fmt::format("date = {}\n", quoted(f.date));
  if (!f.counter.empty())
    out += fmt::format("counter = {}\ntick    = \"{}\"\nwrap    = {:.0f}\n", quoted(f.counter),
                       duration_text(f.tick.value_or(0.0)), f.wrap.value_or(0.0));
  if (!file.counter.empty())
    out += fmt::format(
        "counter = {}\ntick    = \"[?]\"  # from one count to the next; wrap = where it begins "
        "again\n",
        quoted(file.counter));
  for (const auto& [text, number] : file.format.positions)
    positions += fmt::format("{}{} = {}", positions.empty() ? "" : ", ", quoted(text), number);
  if (!positions.empty()) out += fmt::format("positions = {{ {} }}\n", positions);
  return out;
}

std::string what_is_missing(const GuessedFile& file) {
  const auto has = [&](std::string_view channel) {
    return std::ranges::find(file.columns, channel, &GuessedColumn::channel) != file.columns.end();
  };
  const bool on_case = file.kind == RecordingKind::strapdown;
  std::vector<std::string> what, keys, fitting;
  const auto need = [&](std::string_view name, std::string_view key, std::string_view unit,
                        const std::string& column = "COLUMN") {
    if (has(key)) return;
    if (what.empty() || what.back() != name) what.emplace_back(name);
    keys.push_back(fmt::format("{} = {}", key,
                               quoted(column == "COLUMN" ? column + std::string(unit) : column)));
  };
  if (file.format.counter.empty() && file.counter.empty()) need("the time", "time", " [s]");
  const auto need_all = [&](const ChannelTriple& t, std::string_view unit) {
    const std::vector<std::string> such = in_units_of(file, t.names.front());
    for (std::size_t a = 0; a < t.names.size(); ++a)
      need(t.what, t.names[a], unit, such.size() == t.names.size() ? such[a] : "COLUMN");
    if (!what.empty() && what.back() == t.what)
      for (const std::string& name : such) fitting.push_back(quoted(name));
  };
  need_all(accelerometer_channels, " [g]");
  if (on_case)
    need_all(gyro_channels, " [deg/s]");
  else
    need_all(gimbal_channels, " [deg]");
  const std::string counted =
      on_case || has("position")
          ? ""
          : "No column seems to be the number of the position: they are counted, from turn to "
            "turn; "
            "if the file has it, add position = \"COLUMN\" to columns of [recording].";
  if (what.empty()) return counted;
  // Where the others of its kind are named, one is missed by its own name.
  if (what.size() == 1 && keys.size() < 3 &&
      (what.front() == accelerometer_channels.what || what.front() == gimbal_channels.what ||
       what.front() == gyro_channels.what)) {
    what.clear();
    for (const std::string& key : keys) what.push_back(key.substr(0, key.find(' ')));
  }
  std::string text = fmt::format(
      "No column seems to be {}: if the file has it, add {} to columns of [recording], with the "
      "name and the unit of the column.",
      fmt::join(what, " or "), fmt::join(keys, ", "));
  if (!fitting.empty())
    text += fmt::format(" In such a unit and without a place {} {}: check which is which.",
                        fitting.size() == 1 ? "is" : "are", fmt::join(fitting, ", "));
  return counted.empty() ? text : text + " " + counted;
}

std::string what_has_no_place(const GuessedFile& file) {
  constexpr std::size_t most = 8;
  std::vector<std::string> names, quotes;
  const bool commanded = std::ranges::any_of(
      file.columns, [](const GuessedColumn& c) { return c.channel.starts_with("cmd_"); });
  const auto rates = file.kind == RecordingKind::platform && !commanded
                         ? in_units_of(file, "cmd_x")
                         : std::vector<std::string>();
  const std::string commands =
      rates.empty() ? ""
                    : fmt::format(
                          "No column is called a command, and {} {} in a unit of rates: if "
                          "the platform was told so, write cmd_x, cmd_y, cmd_z = \"the "
                          "header as it stands\" in columns of [recording]; without "
                          "commands those of the plan are taken. ",
                          listed_up_to(rates, most), rates.size() == 1 ? "is" : "are");
  for (const GuessedColumn* c : free_columns(file)) {
    names.push_back(in_quotes(with_unit(*c)));
    quotes.push_back(quoted(c->header.name));
  }
  if (names.empty()) return "";
  const bool one = names.size() == 1;
  return commands +
         fmt::format(
             "{} {} no channel that the program knows and {} carried under {} own name{}: name "
             "what {} in "
             "columns of [recording], or leave {} out with ignore = [{}{}].",
             listed_up_to(names, most), one ? "is" : "are", one ? "is" : "are",
             one ? "its" : "their", one ? "" : "s", one ? "it is" : "they are", one ? "it" : "them",
             fmt::join(quotes.begin(),
                       quotes.begin() + static_cast<std::ptrdiff_t>(std::min(most, quotes.size())),
                       ", "),
             quotes.size() > most ? ", ..." : "");
}

}  // namespace drift
