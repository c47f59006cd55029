#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace drift::report {

/// How a cell is to be taken; colours it in HTML.
enum class Tone { plain, good, doubtful, bad };

/// What machines read in a cell. Nothing, and a number that is not finite, is null in JSON and
/// empty in CSV.
using Value =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>>;

/// A value, and how people see it.
struct Cell {
  Cell(std::string text_ = {}, Tone tone_ = Tone::plain)  // NOLINT: a cell is a text
      : value(text_), text(std::move(text_)), tone(tone_) {}
  Cell(const char* text_) : Cell(std::string(text_)) {}       // NOLINT
  Cell(std::string_view text_) : Cell(std::string(text_)) {}  // NOLINT
  Cell(double number);                                        // NOLINT: in three digits
  template <std::integral T>
  Cell(T number) : Cell(value_of(number), std::to_string(number)) {}  // NOLINT
  Cell(Value value_, std::string text_, Tone tone_ = Tone::plain)
      : value(std::move(value_)), text(std::move(text_)), tone(tone_) {}

  Value value;
  std::string text;
  Tone tone = Tone::plain;

 private:
  static Value value_of(bool yes) { return yes; }
  static Value value_of(std::integral auto count) { return static_cast<std::int64_t>(count); }
};

/// Numbers that people see otherwise than in three digits.
Cell digits(double value, int count, Tone tone = Tone::plain);
Cell decimals(double value, int count, Tone tone = Tone::plain);
Cell plus_minus(double value, double sigma);
Cell p_cell(double p_value);
Cell span_cell(double low, double high);
/// For machines alone.
Cell only_value(Value value);
/// Nothing, for machines, where the text is empty.
Cell text_or_nothing(std::string text);

/// A column: the key names it in JSON and CSV, the heading on the terminal and the page. One
/// without a key is for people alone, one without a heading for machines alone.
struct Column {
  std::string key, heading;
  bool left = false;  ///< how it is aligned
  bool shown = true;  ///< to people
};

/// A row of cells, one for each column, or a heading across the whole table (one cell).
struct TableRow {
  std::vector<Cell> cells;
  bool heading = false;
  bool always = false;  ///< shown whatever the limit
};

/// How many rows people see, and the file that they find the others in. Machines get them all.
struct RowLimit {
  std::size_t terminal = std::numeric_limits<std::size_t>::max(), page = terminal;
  std::string rest_in = {};
};

/// What is shown as a table, on a terminal or a page, or read by machines.
struct Table {
  Table() = default;
  Table(std::string title_, std::string_view columns_, std::string note_ = {});

  std::string title;
  std::vector<Column> columns;
  std::vector<TableRow> rows;
  std::string note = {};  ///< below the table; may be empty
  /// Its name in the JSON document of the report, and of a CSV file; empty: in neither.
  std::string id = {};
  RowLimit limit = {};

  /// "key=heading | ...": without "key=" for people alone; '<' before a heading aligns left.
  void add_columns(std::string_view spec);
  void add(std::vector<Cell> cells) { rows.push_back({std::move(cells)}); }
  void add_heading(std::string text) { rows.push_back({{Cell(std::move(text))}, true}); }
};

/// What people see of a table: the columns with a heading, at most so many rows, and in the note
/// where the others are.
Table shown(const Table& table, std::size_t most);

/// Plain text, each line ended; columns are two spaces apart, or one if two do not fit in `width`.
/// Title and note are wrapped, and so is a last column of words that does not fit.
std::string text_of(const Table& table, std::size_t width = 100);

/// Width of the rows with one space between columns [columns of a terminal].
std::size_t text_width(const Table& table);

/// A <table> with caption; everything escaped.
std::string html_of(const Table& table);

/// The rows with the keys of the columns, comma-separated; what would break a line of it is blank
/// in text.
std::string csv_of(const Table& table);

/// Text broken at spaces into lines of at most `width`; all but the first are indented.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent = 0);

/// Text as comment lines of a TOML file, "# ..."; empty of an empty one.
std::string as_comment(const std::string& text);

}  // namespace drift::report
