#include "analysis/report/identify/folder.hpp"

#include <filesystem>

#include "analysis/report/identify/figures.hpp"
#include "analysis/report/identify/html.hpp"
#include "analysis/report/identify/json.hpp"
#include "core/base/results_folder.hpp"

namespace drift::report {

std::vector<std::string> write_results(const mc::Study& study,
                                       const identification::Identification& id,
                                       const std::string& folder) {
  // Everything is made before anything is written: what fails then is the disk alone.
  const std::vector<Figure> figures = identification_figures(study, id);
  std::vector<TextFile> files;
  files.emplace_back("identification.json", to_json(study, id));
  for (const Figure& f : figures) files.emplace_back(f.file, f.svg);
  files.emplace_back("report.html", to_html(identification_html(study, id, figures)));
  if (!study.text.empty()) files.emplace_back("study.toml", study.text);
  std::vector<std::string> names = write_files(files, folder);
  if (id.recording.rows() > 0) {
    write_recording(id.recording, (std::filesystem::path(folder) / "recording.csv").string());
    names.emplace_back("recording.csv");
  }
  return names;
}

}  // namespace drift::report
