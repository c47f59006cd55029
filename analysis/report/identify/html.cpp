#include "analysis/report/identify/html.hpp"

#include "analysis/report/identify/published_table.hpp"
#include "analysis/report/identify/tables.hpp"

namespace drift::report {
namespace {

constexpr std::size_t most_starts = 6;  // columns of a page

Section filter_section(const mc::Study& study, const identification::Identification& id,
                       std::size_t filter) {
  const std::vector<std::string> lines = filter_lines(study.filters[filter]);
  Section section{lines.front(), {}};
  section.blocks.emplace_back(Sentences{{lines.begin() + 1, lines.end()}});
  section.blocks.emplace_back(fit_table(study, id, filter));
  section.blocks.emplace_back(
      estimate_table(study, id, filter, {.starts = most_starts, .unit_columns = true}));
  section.blocks.emplace_back(degeneracy_table(study, id, filter));
  return section;
}

Section study_section(const mc::Study& study) {
  Table table;
  table.columns = {{"key", Align::left}, {"value", Align::left}, {"from", Align::left}};
  for (const mc::Resolved& r : study.resolved) table.add({r.key, r.value, r.origin});
  return {"Study",
          {Paragraph{"Every value the study resolves to, and where it comes from."}, table}};
}

}  // namespace

HtmlReport identification_html(const mc::Study& study, const identification::Identification& id,
                               const std::vector<Figure>& figures) {
  HtmlReport report;
  report.title = study.title.empty() ? "Identification" : study.title;
  report.subtitle = source_line(study, id);
  report.headlines = headlines(study, id);
  Section pictures{"Estimates against time", {}};
  for (const Figure& f : figures)
    if (!f.file.starts_with("figure_")) pictures.blocks.emplace_back(Picture{f.svg, f.caption});
  if (!pictures.blocks.empty()) report.sections.push_back(std::move(pictures));
  if (auto tables = published_comparison(study, id); !tables.empty()) {
    Section section{"Published results beside ours", {}};
    for (Table& t : tables) section.blocks.emplace_back(std::move(t));
    report.sections.push_back(std::move(section));
  }
  for (const identification::FilterSummary& s : id.summaries)
    report.sections.push_back(filter_section(study, id, s.filter));
  if (!study.resolved.empty()) report.sections.push_back(study_section(study));
  report.footer = "Written by driftscope identify. Values stand with their units; ± is 1 sigma.";
  return report;
}

}  // namespace drift::report
