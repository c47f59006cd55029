#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/config/node.hpp"
#include "core/recording/own/guess.hpp"
#include "core/recording/recording_channels.hpp"

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

/// What is to be checked of columns whose names said nothing, as a comment.
std::string guessed_by_values(const GuessedFile& file) {
  const auto by_values = [&](std::string_view channel) {
    return std::ranges::any_of(
        file.columns, [&](const GuessedColumn& c) { return c.by_values && c.channel == channel; });
  };
  std::string text;
  if (by_values("acc_x")) text = "acc_x, acc_y, acc_z are in the order of the columns: check";
  if (by_values("case_heading"))
    text += fmt::format("{}case_heading by its values: check", text.empty() ? "" : "; ");
  if (by_values("position"))
    text += fmt::format("{}position by its texts: check", text.empty() ? "" : "; ");
  return text.empty() ? "" : "  # " + text;
}

}  // namespace
  for (const GuessedColumn& c : file.columns)
    if (c.channel == "temperature" && own_name(c) != c.header.name)
      text += fmt::format("{}temperature in [{}] by its values: check", text.empty() ? "" : "; ",
                          c.unit);

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
  out += columns.empty()
             ? "# columns = { time = \"column_1 [s]\", gyro_x = \"column_2 [rad/s]\" }\n"
             : fmt::format("columns = {{ {} }}{}\n", columns, guessed_by_values(file));
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
  std::vector<std::string> what, keys;
  const auto need = [&](std::string_view name, std::string_view key, std::string_view unit) {
    if (has(key)) return;
    if (what.empty() || what.back() != name) what.emplace_back(name);
    keys.push_back(fmt::format("{} = \"COLUMN{}\"", key, unit));
  };
  if (file.format.counter.empty() && file.counter.empty()) need("the time", "time", " [s]");
  if (!on_case) need("the number of the position", "position", "");
  const auto need_all = [&](const ChannelTriple& t, std::string_view unit) {
    for (const auto name : t.names) need(t.what, name, unit);
  };
  need_all(accelerometer_channels, " [g]");
  if (on_case)
    need_all(gyro_channels, " [deg/s]");
  else
    need_all(gimbal_channels, " [deg]");
  if (what.empty()) return {};
  return fmt::format(
      "No column seems to be {}: if the file has it, add {} to columns of [recording], with the "
      "name and the unit of the column.",
      fmt::join(what, " or "), fmt::join(keys, ", "));
}

}  // namespace drift
