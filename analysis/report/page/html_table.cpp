#include <fmt/format.h>

#include <algorithm>

#include "analysis/report/page/escape.hpp"
#include "analysis/report/page/table.hpp"
#include "analysis/report/page/tone_class.hpp"

namespace drift::report {
namespace {

std::size_t longest_word(std::string_view text) {
  std::size_t longest = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    longest = std::max(longest, display_width(text.substr(at, end - at)));
    at = end + 1;
  }
  return longest;
}

/// What the texts of a column need [characters].
struct ColumnText {
  bool left = false;
  std::size_t longest = 0, word = 0;  ///< text, and word of a text or of the heading

  /// Sentences, which take the width that others leave.
  bool remarks() const { return left && longest > 40; }
  /// On paper, where headings and texts on the left are broken at spaces.
  std::size_t least() const {
    constexpr std::size_t of_remark = 18;  // page_style: 10em
    return std::max(word, remarks() ? of_remark : left ? 0 : longest);
  }
};

std::vector<ColumnText> texts_of(const Table& table) {
  std::vector<ColumnText> texts;
  for (const Column& column : table.columns)
    texts.push_back({.left = column.left, .word = longest_word(column.heading)});
  for (const TableRow& row : table.rows)
    for (std::size_t c = 0; !row.heading && c < row.cells.size(); ++c) {
      texts[c].longest = std::max(texts[c].longest, display_width(row.cells[c].text));
      texts[c].word = std::max(texts[c].word, longest_word(row.cells[c].text));
    }
  return texts;
}

/// Whether a page of A4 takes a table upright, in type of 8 pt as page_style has it on paper.
bool fits_upright(const std::vector<ColumnText>& texts) {
  constexpr double sheet = 186.0 / 25.4 * 96.0, letter = 0.56 * 8.0 / 72.0 * 96.0,
                   padding = 2.0 * 0.35 * 16.0;  // [px]
  double width = 0.0;
  for (const ColumnText& t : texts) width += static_cast<double>(t.least()) * letter + padding;
  return width <= sheet;
}

}  // namespace

std::string html_of(const Table& whole) {
  const Table table = shown(whole, whole.limit.page);
  const std::vector<ColumnText> texts = texts_of(table);
  const bool wide = !fits_upright(texts);
  const auto side = [&](std::size_t c) { return table.columns[c].left ? "left" : "right"; };
  std::string out =
      fmt::format("{}<div class=\"scroll\"><table>\n", wide ? "<div class=\"wide\">" : "");
  if (!table.title.empty()) out += "<caption>" + escaped(table.title) + "</caption>\n";
  out += "<thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out += fmt::format("<th scope=\"col\" class=\"{}\">{}</th>", side(c),
                       escaped(table.columns[c].heading));
  out += "</tr></thead>\n<tbody>\n";
  for (const TableRow& row : table.rows) {
    out += "<tr>";
    if (row.heading)
      out += fmt::format("<th colspan=\"{}\" class=\"left\">{}</th>", table.columns.size(),
                         escaped(row.cells.front().text));
    else
      for (std::size_t c = 0; c < row.cells.size(); ++c)
        out += fmt::format("<td class=\"{}{}{}\">{}</td>", side(c), tone_class(row.cells[c].tone),
                           texts[c].remarks() ? " remark" : "", escaped(row.cells[c].text));
    out += "</tr>\n";
  }
  out += "</tbody></table></div>\n";
  if (!table.note.empty()) out += "<p class=\"note\">" + escaped(table.note) + "</p>\n";
  return out + (wide ? "</div>\n" : "");
}

}  // namespace drift::report
