#include "analysis/report/page/report.hpp"

#include <algorithm>
#include <set>

#include "core/base/check.hpp"

namespace drift::report {

void Report::add(std::vector<Section> more) {
  for (Section& section : more)
    if (!section.blocks.empty()) sections.push_back(std::move(section));
}

namespace {

/// With the filter it is about as its first column.
Table of_filter(Table table, const std::string& filter) {
  table.columns.insert(table.columns.begin(), {"filter", "filter"});
  for (TableRow& row : table.rows)
    if (!row.heading) row.cells.insert(row.cells.begin(), filter);
  return table;
}

}  // namespace

std::vector<TextFile> csv_files(const std::vector<Section>& sections) {
  std::vector<TextFile> files;
  std::set<std::pair<std::string, std::string>> written;
  for (const Section& section : sections)
    for (const Block& block : section.blocks) {
      const auto* table = std::get_if<Table>(&block.content);
      // One that a terminal and a page show in their own ways stands there twice.
      if (!table || table->id.empty() || !written.emplace(table->id, section.filter).second)
        continue;
      const std::string text =
          csv_of(section.filter.empty() ? *table : of_filter(*table, section.filter));
      const std::string name = table->id + ".csv";
      const auto file = std::ranges::find(files, name, &TextFile::first);
      if (file == files.end()) {
        files.emplace_back(name, text);
        continue;
      }
      const std::size_t head = text.find('\n') + 1;
      DRIFT_EXPECTS(file->second.starts_with(text.substr(0, head)));
      file->second += text.substr(head);
    }
  return files;
}

void add_report(NewResults& results, const Report& report) {
  // Everything is made before anything is written: what fails then is the disk alone.
  std::vector<TextFile> files{report.document};
  files.insert(files.end(), report.files.begin(), report.files.end());
  const std::vector<TextFile> tables = csv_files(report.sections);
  files.insert(files.end(), tables.begin(), tables.end());
  for (const Section& section : report.sections)
    for (const Block& block : section.blocks)
      if (const auto* figure = std::get_if<Figure>(&block.content); figure && !figure->file.empty())
        files.emplace_back(figure->file, figure->svg);
  files.emplace_back("report.html", to_html(report));
  for (const auto& [name, text] : files) results.add(name, text);
}

std::vector<std::string> write_report(const Report& report, const std::string& folder) {
  NewResults results({folder, report.command});
  add_report(results, report);
  return results.commit();
}

}  // namespace drift::report
