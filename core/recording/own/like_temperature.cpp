#include "core/recording/own/like_temperature.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {

bool looks_like_temperature(const HeaderCell& cell) {
  if (cell.unit)
    if (const auto unit = parse_recording_unit(*cell.unit)) return unit->dim == "K"_unit.dim;
  if (const auto unit = parse_recording_unit(unit_of_symbol(cell.name)); unit && !cell.unit)
    return unit->dim == "K"_unit.dim;
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
  return fmt::format(
      "{} look{} like a temperature, but no column is mapped as one: write "
      "temperature = \"{}{}\" in columns of [recording]",
      fmt::join(names, ", "), names.size() == 1 ? "s" : "", first.name,
      known ? fmt::format(" [{}]", *first.unit) : " [degC]");
}

}  // namespace drift
