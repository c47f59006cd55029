#include "analysis/report/page/table.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "analysis/report/page/escape.hpp"
#include "core/base/check.hpp"

namespace drift::report {
namespace {

std::vector<std::size_t> column_widths(const Table& table) {
  std::vector<std::size_t> widths;
  for (const Column& c : table.columns) widths.push_back(display_width(c.name));
  for (const TableRow& row : table.rows) {
    if (row.heading) continue;
    DRIFT_EXPECTS(row.cells.size() == widths.size());
    for (std::size_t c = 0; c < widths.size(); ++c)
      widths[c] = std::max(widths[c], display_width(row.cells[c].text));
  }
  return widths;
}

void append_padded(std::string& line, const std::string& text, Align align, std::size_t width) {
  const std::string blank(width - display_width(text), ' ');
  line += align == Align::right ? blank + text : text + blank;
}

void append_line(std::string& out, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  out += line + '\n';
}

std::string_view tone_class(Tone tone) {
  switch (tone) {
    case Tone::good:
      return " good";
    case Tone::doubtful:
      return " doubtful";
    case Tone::bad:
      return " bad";
    case Tone::plain:
      break;
  }
  return "";
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
  std::istringstream words(text);
  std::string out, word, line;
  std::size_t margin = 0;
  while (words >> word) {
    const std::size_t length = display_width(line);
    if (length > margin && length + 1 + display_width(word) > width) {
      out += line + '\n';
      line.assign(indent, ' ');
      margin = indent;
    }
    if (display_width(line) > margin) line += ' ';
    line += word;
  }
  return out + line + '\n';
}

std::size_t text_width(const Table& table) {
  std::size_t total = 0;
  for (const std::size_t w : column_widths(table)) total += w + 1;
  return total > 0 ? total - 1 : 0;
}

std::string text_of(const Table& table, std::size_t width) {
  const auto widths = column_widths(table);
  const std::size_t narrow = text_width(table), wide = narrow + widths.size() - 1;
  const std::string gap(wide <= width ? 2 : 1, ' ');
  std::string out, line;
  if (!table.title.empty()) out += wrapped(table.title, width);
  for (std::size_t c = 0; c < widths.size(); ++c) {
    if (c > 0) line += gap;
    append_padded(line, table.columns[c].name, table.columns[c].align, widths[c]);
  }
  append_line(out, line);
  append_line(out, std::string(wide <= width ? wide : std::min(narrow, width), '-'));
  for (const TableRow& row : table.rows) {
    if (row.heading) {
      out += wrapped(row.cells.front().text, width, 4);
      continue;
    }
    line.clear();
    for (std::size_t c = 0; c < widths.size(); ++c) {
      if (c > 0) line += gap;
      append_padded(line, row.cells[c].text, table.columns[c].align, widths[c]);
    }
    append_line(out, line);
  }
  if (!table.note.empty()) out += wrapped(table.note, width);
  return out;
}

std::string html_of(const Table& table) {
  std::string out = "<div class=\"scroll\"><table>\n";
  if (!table.title.empty()) out += "<caption>" + escaped(table.title) + "</caption>\n";
  out += "<thead><tr>";
  const auto side = [](Align align) { return align == Align::left ? "left" : "right"; };
  for (const Column& c : table.columns)
    out += fmt::format("<th scope=\"col\" class=\"{}\">{}</th>", side(c.align), escaped(c.name));
  out += "</tr></thead>\n<tbody>\n";
  for (const TableRow& row : table.rows) {
    out += "<tr>";
    if (row.heading)
      out += fmt::format("<th colspan=\"{}\" class=\"left\">{}</th>", table.columns.size(),
                         escaped(row.cells.front().text));
    else
      for (std::size_t c = 0; c < row.cells.size(); ++c)
        out += fmt::format("<td class=\"{}{}\">{}</td>", side(table.columns[c].align),
                           tone_class(row.cells[c].tone), escaped(row.cells[c].text));
    out += "</tr>\n";
  }
  out += "</tbody></table></div>\n";
  if (!table.note.empty()) out += "<p class=\"note\">" + escaped(table.note) + "</p>\n";
  return out;
}

}  // namespace drift::report
