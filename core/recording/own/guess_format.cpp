#include "core/recording/own/guess_format.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/recording/own/recording_unit.hpp"

namespace drift {

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

}  // namespace drift
