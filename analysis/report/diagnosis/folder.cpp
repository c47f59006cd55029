#include "analysis/report/diagnosis/folder.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "analysis/diagnosis/patched_study.hpp"
#include "analysis/diagnosis/sentence.hpp"
#include "analysis/report/diagnosis/json.hpp"
#include "analysis/report/diagnosis/residual_signal.hpp"
#include "analysis/report/page/table.hpp"
#include "core/base/results_folder.hpp"

namespace drift::report {
namespace {

/// A text as comment lines of a study file.
std::string commented(const std::string& text) {
  std::string out;
  std::istringstream lines(wrapped(text, 98));
  for (std::string line; std::getline(lines, line);) out += "# " + line + "\n";
  return out;
}

/// The patched study; where several causes remain possible, headed by what it holds.
std::string patched_file(const mc::Study& study, const diagnosis::Diagnosis& d) {
  const std::string head = diagnosis::patch_text(d);
  return (head.empty() ? "" : commented(head)) + diagnosis::patched_study(study, d.patched);
}

}  // namespace

std::vector<std::string> write_results(const mc::Study& study, const diagnosis::Diagnosis& d,
                                       const DiagnosisSource& source, const std::string& folder) {
  // Everything is made before anything is written: what fails then is the disk alone.
  std::vector<TextFile> files{
      {"diagnosis.json", to_json(d)},
      {"residual_signal.csv", residual_signal_csv(d.signals, d.where.recordings)},
      {"report.html", to_html(diagnosis_html(study, d, source))},
      {"study.toml", study.text}};
  for (Figure& f : diagnosis_figures(d)) files.emplace_back(f.file, std::move(f.svg));
  if (d.has_patch) files.emplace_back("patched.toml", patched_file(study, d));
  if (!d.advice.empty() && !d.advice.front().plan.empty() && study.kind == RecordingKind::platform)
    files.emplace_back("advised.toml", diagnosis::extended_study(study, d.advice.front().plan));
  for (const char* name : {"patched.toml", "advised.toml"}) {
    std::error_code ignored;
    if (std::ranges::none_of(files, [&](const TextFile& f) { return f.first == name; }))
      std::filesystem::remove(std::filesystem::path(folder) / name, ignored);
  }
  return write_files(files, folder);
}

}  // namespace drift::report
