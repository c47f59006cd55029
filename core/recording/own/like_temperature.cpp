#include "core/recording/own/like_temperature.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

/// How the remark goes on after the names: by this it is found again among others.
constexpr std::string_view mark = "like a temperature, but no column is mapped as one";

}  // namespace

bool looks_like_temperature(const HeaderCell& cell) {
  if (cell.unit)
    if (const auto unit = parse_recording_unit(*cell.unit)) return unit->dim == "K"_unit.dim;
  const std::string name = lower_case(folded(cell.name));
  if (name.find("temperat") != std::string::npos) return true;
  for (std::size_t begin = 0; begin < name.size();) {  // "Temp", "Temp_1", "T oil temp."
    const auto end = std::min(name.find_first_of(" _.-0123456789", begin), name.size());
    if (name.substr(begin, end - begin) == "temp") return true;
    begin = end + 1;
  }
  return false;
}

std::string unmapped_temperature_remark(const std::vector<HeaderCell>& cells) {
  std::vector<std::string> names;
  for (const HeaderCell& c : cells) names.push_back(in_quotes(c.whole));
  const HeaderCell& first = cells.front();
  const bool known = first.unit && parse_recording_unit(*first.unit);
  return fmt::format("{} look{} {}: write temperature = \"{}{}\" in columns of [recording]",
                     fmt::join(names, ", "), names.size() == 1 ? "s" : "", mark, first.name,
                     known ? fmt::format(" [{}]", *first.unit) : " [degC]");
}

std::string unmapped_temperature(const Recording& recording) {
  if (recording.find("temperature")) return "";
  // One without a known unit is carried under another name, with a remark that begins with its own.
  const bool without_unit = recording.find("temperature_raw");
  const auto found = std::ranges::find_if(recording.remarks, [&](const std::string& remark) {
    return remark.find(mark) != std::string::npos ||
           (without_unit && remark.starts_with("temperature: "));
  });
  return found == recording.remarks.end() ? "" : *found;
}

}  // namespace drift
