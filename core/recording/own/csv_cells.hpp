#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording/recording_format.hpp"

namespace drift {

/// Cuts lines into cells: without blanks around them, a cell in double quotes without those. A
/// blank as delimiter stands for any number of blanks.
class CellSplitter {
 public:
  explicit CellSplitter(char delimiter) : delimiter_(delimiter) {}

  char delimiter() const { return delimiter_; }
  /// The cells of a line, valid until the call after it.
  const std::vector<std::string_view>& split(std::string_view line);
  /// The same of a row below a header of `width` cells: many loggers end their rows, and not their
  /// header, with one delimiter more. What stands behind it is no cell if it is empty.
  const std::vector<std::string_view>& split_row(std::string_view line, std::size_t width);

 private:
  char delimiter_;
  std::vector<std::string_view> cells_;
};

/// A line without the checksum "*1a2b3c4d" or "*5f" that NovAtel and NMEA put at its end.
std::string_view without_checksum(std::string_view line);

/// What a cell holds.
struct ParsedCell {
  enum class Kind { number, text, out_of_range, wrong_mark };
  Kind kind = Kind::text;
  double value = 0.0;  ///< of a number; NaN for an empty cell
  char mark = 0;       ///< '.' or ',' where the number has one
};

/// Reads a cell, whatever the locale. `decimal` automatic: point or comma.
ParsedCell parse_cell(std::string_view text, DecimalMark decimal);

/// Whether a cell may hold a number, or an instant.
bool begins_like_number(std::string_view cell);

/// The number in a cell, with point or comma; NaN for none.
double cell_number(std::string_view cell);

/// Three nines and more and no other digit but zeros behind the mark, as loggers write what was not
/// measured: -9999, 999.99, 99999.000.
bool is_all_nines(std::string_view cell);

/// Text in lower case; letters of ASCII alone.
std::string lower_case(std::string_view text);

}  // namespace drift
