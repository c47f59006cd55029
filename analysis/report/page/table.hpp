#pragma once

#include <string>
#include <vector>

namespace drift::report {

/// How a cell is to be taken; colours it in HTML.
enum class Tone { plain, good, doubtful, bad };

struct Cell {
  Cell(std::string text_ = {}, Tone tone_ = Tone::plain)  // NOLINT: a cell is a text
      : text(std::move(text_)), tone(tone_) {}
  Cell(const char* text_) : text(text_) {}  // NOLINT
  std::string text;
  Tone tone = Tone::plain;
};

enum class Align { left, right };

struct Column {
  std::string name;
  Align align = Align::right;
};

/// A row of cells, one for each column, or a heading across the whole table (one cell).
struct TableRow {
  std::vector<Cell> cells;
  bool heading = false;
};

/// What is shown as a table, on a terminal or in HTML.
struct Table {
  std::string title;
  std::vector<Column> columns;
  std::vector<TableRow> rows;
  std::string note;  ///< below the table; may be empty

  void add(std::vector<Cell> cells) { rows.push_back({std::move(cells), false}); }
  void add_heading(std::string text) { rows.push_back({{Cell(std::move(text))}, true}); }
};

/// Plain text, each line ended; columns are two spaces apart, or one if two do not fit in `width`.
/// Title and note are wrapped.
std::string text_of(const Table& table, std::size_t width = 100);

/// Width of the rows with one space between columns [columns of a terminal].
std::size_t text_width(const Table& table);

/// A <table> with caption; everything escaped.
std::string html_of(const Table& table);

/// Text broken at spaces into lines of at most `width`; all but the first are indented.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent = 0);

}  // namespace drift::report
