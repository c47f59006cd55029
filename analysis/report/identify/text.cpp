#include "analysis/report/identify/text.hpp"

#include "analysis/report/identify/published_table.hpp"
#include "analysis/report/identify/tables.hpp"

namespace drift::report {
namespace {

constexpr std::size_t page = 100;  // columns

/// With as many starts as fit.
Table fitting_estimates(const mc::Study& study, const identification::Identification& id,
                        std::size_t filter) {
  for (std::size_t starts = 3; starts > 1; --starts)
    if (Table t = estimate_table(study, id, filter, {.starts = starts}); text_width(t) <= page)
      return t;
  return estimate_table(study, id, filter, {.starts = 1});
}

/// Directions under their common reason.
std::string degeneracies(const Table& table) {
  std::string out = wrapped(table.title, page), reason;
  for (const TableRow& row : table.rows) {
    if (row.cells[1].text != reason && !row.cells[1].text.empty())
      out += "  " + wrapped(row.cells[1].text + ":", page - 2, 4);
    reason = row.cells[1].text;
    out += (reason.empty() ? "  " : "    ") + wrapped(row.cells[0].text, page - 4, 6);
  }
  return out;
}

}  // namespace

std::string to_text(const mc::Study& study, const identification::Identification& id) {
  std::string out = wrapped(study.title, page) + wrapped(source_line(study, id), page);
  for (const identification::FilterSummary& s : id.summaries) {
    out += '\n';
    for (const std::string& line : filter_lines(study.filters[s.filter]))
      out += wrapped(line, page, 10);
    out += '\n' + text_of(fit_table(study, id, s.filter), page);
    out += '\n' + text_of(fitting_estimates(study, id, s.filter), page);
    out += '\n' + degeneracies(degeneracy_table(study, id, s.filter));
  }
  for (const Table& table : published_comparison(study, id)) out += '\n' + text_of(table, page);
  out += '\n';
  for (const std::string& sentence : headlines(study, id)) out += wrapped(sentence, page, 2);
  return out;
}

}  // namespace drift::report
