#include "analysis/report/page/report.hpp"

namespace drift::report {

void Report::add(std::vector<Section> more) {
  for (Section& section : more)
    if (!section.blocks.empty()) sections.push_back(std::move(section));
}

std::vector<std::string> write_report(const Report& report, const std::string& folder) {
  // Everything is made before anything is written: what fails then is the disk alone.
  std::vector<TextFile> files{report.document};
  files.insert(files.end(), report.files.begin(), report.files.end());
  for (const Section& section : report.sections)
    for (const Block& block : section.blocks)
      if (const auto* figure = std::get_if<Figure>(&block.content); figure && !figure->file.empty())
        files.emplace_back(figure->file, figure->svg);
  files.emplace_back("report.html", to_html(report));
  return write_files({folder, report.command}, files);
}

}  // namespace drift::report
