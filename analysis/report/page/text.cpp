#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <sstream>

#include "analysis/report/page/escape.hpp"
#include "analysis/report/page/report.hpp"

namespace drift::report {
namespace {

constexpr std::size_t least_words = 20;  // columns of a terminal that a last column of words keeps

std::vector<std::size_t> column_widths(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    widths.push_back(display_width(table.columns[c].heading));
    for (const TableRow& row : table.rows)
      if (!row.heading) widths[c] = std::max(widths[c], display_width(row.cells[c].text));
  }
  return widths;
}

/// With one space between columns.
std::size_t narrowest(const std::vector<std::size_t>& widths) {
  return std::accumulate(widths.begin(), widths.end(), widths.size()) - (widths.empty() ? 0 : 1);
}

void append_line(std::string& out, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  out += line + '\n';
}

/// One line of a table; a last column wider than it should be takes several.
std::string line_of(const Table& table, const std::vector<std::size_t>& widths,
                    std::string_view gap, auto text_at) {
  std::string out, line;
  for (std::size_t c = 0; c < widths.size(); ++c) {
    if (c > 0) line += gap;
    const std::string& text = text_at(c);
    const std::size_t size = display_width(text);
    if (size > widths[c]) {
      std::istringstream pieces(wrapped(text, widths[c]));
      const std::string margin(display_width(line), ' ');
      for (std::string piece; std::getline(pieces, piece); line = margin)
        append_line(out, line + piece);
      return out;
    }
    const std::string blank(widths[c] - size, ' ');
    line += table.columns[c].left ? text + blank : blank + text;
  }
  append_line(out, line);
  return out;
}

bool is_blank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

struct BlockText {
  std::size_t width;
  std::string operator()(const Paragraph& p) const { return wrapped(p.text, width, 2); }
  std::string operator()(const Sentences& s) const {
    std::string out;
    for (const std::string& item : s.items) out += wrapped(s.mark + item, width, 2);
    return out;
  }
  std::string operator()(const Preformatted& p) const { return p.text; }
  std::string operator()(const Table& t) const { return text_of(t, width); }
  std::string operator()(const Figure&) const { return ""; }
};

/// Where the word ends that a text begins with: at a blank outside of the quotes of a shell, in
/// which every blank of a name counts; npos where they do not close.
std::size_t end_of_quoted(std::string_view text) {
  bool inside = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (!inside && is_blank(text[k])) return k;
    if (!inside && text[k] == '\\')
      ++k;
    else if (text[k] == '\'')
      inside = !inside;
  }
  return inside ? std::string_view::npos : text.size();
}

/// Takes the next word off a text; empty at its end.
std::string_view next_word(std::string_view& text) {
  const auto begin = std::ranges::find_if_not(text, is_blank);
  text.remove_prefix(static_cast<std::size_t>(begin - text.begin()));
  auto end = static_cast<std::size_t>(std::ranges::find_if(text, is_blank) - text.begin());
  if (text.starts_with('\''))
    if (const std::size_t closed = end_of_quoted(text); closed != std::string_view::npos)
      end = closed;
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
  std::string_view rest = text;
  std::string out, line;
  std::size_t margin = 0;
  for (std::string_view word; !(word = next_word(rest)).empty();) {
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

std::string as_comment(const std::string& text) {
  constexpr std::size_t width = 98;  // behind "# "
  std::istringstream lines(text.empty() ? "" : wrapped(text, width));
  std::string out;
  for (std::string line; std::getline(lines, line);) out += "# " + line + "\n";
  return out;
}

std::size_t text_width(const Table& table) {
  return narrowest(column_widths(shown(table, table.limit.terminal)));
}

std::string text_of(const Table& whole, std::size_t width) {
  const Table table = shown(whole, whole.limit.terminal);
  auto widths = column_widths(table);
  const std::size_t narrow = narrowest(widths), wide = narrow + widths.size() - 1;
  const std::string_view gap = wide <= width ? "  " : " ";
  if (narrow > width && table.columns.back().left) {
    const std::size_t others = narrow - widths.back();
    widths.back() = std::max(width > others ? width - others : 0, least_words);
  }
  std::string out = table.title.empty() ? "" : wrapped(table.title, width);
  out += line_of(table, widths, gap,
                 [&](std::size_t c) -> const std::string& { return table.columns[c].heading; });
  out += std::string(wide <= width ? wide : std::min(narrow, width), '-') + '\n';
  for (const TableRow& row : table.rows)
    out += row.heading ? wrapped(row.cells.front().text, width, 4)
                       : line_of(table, widths, gap, [&](std::size_t c) -> const std::string& {
                           return row.cells[c].text;
                         });
  return out + (table.note.empty() ? "" : wrapped(table.note, width));
}

std::string text_of(const std::vector<Section>& sections, std::size_t width) {
  std::vector<std::string> blocks;
  for (const Section& section : sections)
    for (const Block& block : section.blocks)
      if (seen(section.on, On::terminal) && seen(block.on, On::terminal))
        blocks.push_back(std::visit(BlockText{width}, block.content));
  std::erase(blocks, "");
  return fmt::format("{}", fmt::join(blocks, "\n"));
}

std::string to_text(const Report& report, std::size_t width) {
  std::vector<std::string> parts{wrapped(report.title, width) + wrapped(report.subtitle, width, 2),
                                 BlockText{width}(Sentences{report.headlines}),
                                 text_of(report.sections, width)};
  if (report.order == Order::headlines_last) std::swap(parts[1], parts[2]);
  std::erase(parts, "");
  return fmt::format("{}", fmt::join(parts, "\n"));
}

}  // namespace drift::report
