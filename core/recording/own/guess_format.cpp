#include "core/recording/own/guess_format.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

bool has(const GuessedFile& file, std::string_view start) {
  return std::ranges::any_of(file.columns, [&](const GuessedColumn& c) {
    return !c.by_values && c.channel.starts_with(start);
  });
}

}  // namespace

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
    if (c.channel == "position")
      for (std::size_t i = 0; i < c.words.size(); ++i)
        file.format.positions.emplace_back(c.words[i], static_cast<int>(i + 1));
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
