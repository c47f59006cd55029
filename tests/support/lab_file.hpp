#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::test {

/// A column of a laboratory's file and the channel it holds.
struct LabColumn {
  std::string channel, header, unit;
  double size = 1.0;  ///< of the unit [internal unit]
  int decimals = 6;
  double sign = 1.0;
  double offset = 0.0;  ///< to be added when it is read [internal unit]

  double written(double value) const { return sign * (value - offset) / size; }
  /// What the rounding of the text may take away [internal unit].
  double rounding() const { return 0.5001 * size * std::pow(10.0, -decimals) + 1e-13; }
};

/// A recording as a laboratory would have written it, and the [recording] section that reads it.
struct LabFile {
  enum class Units { study, header, row, round_brackets, none };

  char delimiter = ';';
  char decimal = ',';
  std::string line_end = "\r\n";
  std::vector<std::string> preamble;
  std::vector<LabColumn> columns;
  Units units = Units::study;
  bool mapped = true;  ///< own names, named in [recording]
  bool date = true;    ///< a column of dates and one of remarks
  bool position_names = true;
  bool last_line_end = true;
  std::string more;  ///< further lines of [recording]

  LabFile() {
    const double g = 1.0 / 9.81, rad = 1.0;
    columns = {{"time", "Zeit_ms", "ms", 1e-3, 0, 1.0, 0.0},
               {"position", "Lage", "", 1.0, 0, 1.0, 0.0},
               {"acc_x", "Ax", "m/s^2", g, 8, 1.0, 0.0},
               {"acc_y", "Ay", "m/s^2", g, 8, 1.0, 0.0},
               {"acc_z", "Az", "m/s^2", g, 8, -1.0, 0.0},
               {"gimbal_outer", "Phi_a", "rad", rad, 8, -1.0, 0.0},
               {"gimbal_middle", "Phi_m", "rad", rad, 8, 1.0, 0.0},
               {"gimbal_inner", "Phi_i", "rad", rad, 8, 1.0, 0.5 * M_PI}};
  }

  LabColumn& operator[](const std::string& channel) {
    for (LabColumn& c : columns)
      if (c.channel == channel) return c;
    throw std::out_of_range(channel);
  }

  std::string number(double value, int decimals) const {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (const auto point = text.find('.'); point != std::string::npos) text[point] = decimal;
    return text;
  }

  std::string row(const Recording& r, std::size_t i) const {
    std::string line = date ? fmt::format("01.03.2026{}", delimiter) : "";
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const LabColumn& c = columns[k];
      if (k > 0) line += delimiter;
      const double value = r.find(c.channel)->values[i];
      if (c.channel == "position" && position_names)
        line += fmt::format("Lage {}", static_cast<int>(value));
      else if (std::isfinite(value))
        line += number(c.written(value), c.decimals);
    }
    if (date) line += fmt::format("{}{}", delimiter, i == 3 ? "Kran faehrt" : "");
    return line;
  }

  std::string header_row() const {
    std::string line = date ? fmt::format("Datum{}", delimiter) : "";
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const LabColumn& c = columns[k];
      if (k > 0) line += delimiter;
      line += mapped ? c.header : c.channel;
      if (c.unit.empty()) continue;
      if (units == Units::header) line += " [" + c.unit + "]";
      if (units == Units::round_brackets) line += " (" + c.unit + ")";
    }
    if (date) line += fmt::format("{}Bemerkung", delimiter);
    return line;
  }

  std::vector<std::string> lines(const Recording& r) const {
    std::vector<std::string> all = preamble;
    all.push_back(header_row());
    if (units == Units::row) {
      std::string line = date ? std::string(1, delimiter) : "";
      for (std::size_t k = 0; k < columns.size(); ++k)
        line += (k > 0 ? std::string(1, delimiter) : "") + columns[k].unit;
      if (date) line += delimiter;
      all.push_back(line);
    }
    for (std::size_t i = 0; i < r.rows(); ++i) all.push_back(row(r, i));
    return all;
  }

  std::string text(const Recording& r) const {
    std::string out;
    const auto all = lines(r);
    for (std::size_t i = 0; i < all.size(); ++i)
      out += all[i] + (i + 1 < all.size() || last_line_end ? line_end : "");
    return out;
  }

  std::string section() const {
    std::string out = "\n[recording]\n";
    std::string map, offsets;
    for (const LabColumn& c : columns) {
      const std::string unit = units == Units::study && !c.unit.empty() ? " [" + c.unit + "]" : "";
      map += fmt::format("{}{} = \"{}{}{}\"", map.empty() ? "" : ", ", c.channel,
                         c.sign < 0.0 ? "-" : "", mapped ? c.header : c.channel, unit);
      if (c.offset != 0.0)
        offsets += fmt::format("{}{} = \"{:.17g} {}\"", offsets.empty() ? "" : ", ", c.channel,
                               c.offset, "rad");
    }
    if (mapped || units == Units::study) out += "columns = { " + map + " }\n";
    if (!offsets.empty()) out += "offset = { " + offsets + " }\n";
    if (position_names)
      out += "positions = { \"Lage 1\" = 1, \"Lage 2\" = \"x up\", \"Lage 3\" = 3 }\n";
    return out + more;
  }
};

}  // namespace drift::test
