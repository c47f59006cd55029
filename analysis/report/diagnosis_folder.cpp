#include "analysis/report/diagnosis_folder.hpp"

#include <algorithm>
#include <filesystem>

#include "analysis/discovery/patched_study.hpp"
#include "analysis/report/diagnosis_json.hpp"
#include "analysis/report/residual_signal.hpp"
#include "analysis/report/results_folder.hpp"

namespace drift {

std::vector<std::string> write_results(const Study& study, const discovery::Diagnosis& d,
                                       const DiagnosisSource& source, const std::string& folder) {
  // Everything is made before anything is written: what fails then is the disk alone.
  std::vector<TextFile> files{{"diagnosis.json", to_json(d)},
                              {"residual_signal.csv", residual_signal_csv(d.signals)},
                              {"report.html", to_html(diagnosis_html(study, d, source))},
                              {"study.toml", study.text}};
  for (Figure& f : diagnosis_figures(d)) files.emplace_back(f.file, std::move(f.svg));
  if (d.has_patch) files.emplace_back("patched.toml", discovery::patched_study(study, d.patched));
  if (!d.advice.empty() && !d.advice.front().plan.empty() && study.kind == RecordingKind::platform)
    files.emplace_back("advised.toml", discovery::extended_study(study, d.advice.front().plan));
  for (const char* name : {"patched.toml", "advised.toml"}) {
    std::error_code ignored;
    if (std::ranges::none_of(files, [&](const TextFile& f) { return f.first == name; }))
      std::filesystem::remove(std::filesystem::path(folder) / name, ignored);
  }
  return write_files(files, folder);
}

}  // namespace drift
