#include "analysis/report/results_folder.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "analysis/report/identification_figures.hpp"
#include "analysis/report/identification_html.hpp"
#include "analysis/report/identification_json.hpp"
#include "core/base/check.hpp"
#include "core/sim/atomic_file.hpp"

namespace drift {
namespace {

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad())
    throw InputError(
        ExitCode::io,
        fmt::format("{}: cannot be read again for its copy in the results ({}). Leave the "
                    "study file where it is while the program runs",
                    path, std::strerror(errno)));
  return text;
}

}  // namespace

void write_text_atomically(const std::string& path, std::string_view text) {
  AtomicFile target(path);
  const auto failed = [&] { throw_cannot_write(path, std::strerror(errno)); };
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(target.temporary().c_str(), "we"),
                                                       &std::fclose);
  if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size()) failed();
  if (std::fclose(file.release()) != 0) failed();  // a full disk may show only here
  target.commit();
}

std::vector<std::string> write_results(const Study& study, const Identification& id,
                                       const std::string& folder) {
  // Everything is made before anything is written: what fails then is the disk alone.
  const std::vector<Figure> figures = identification_figures(study, id);
  std::vector<std::pair<std::string, std::string>> files;
  files.emplace_back("identification.json", to_json(study, id));
  for (const Figure& f : figures) files.emplace_back(f.file, f.svg);
  files.emplace_back("report.html", to_html(identification_html(study, id, figures)));
  if (!study.path.empty()) files.emplace_back("study.toml", text_of_file(study.path));

  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw_cannot_write(folder, error.message());
  const std::filesystem::path root(folder);
  std::vector<std::string> names;
  for (const auto& [name, text] : files) {
    write_text_atomically((root / name).string(), text);
    names.push_back(name);
  }
  if (id.recording.rows() > 0) {
    write_recording(id.recording, (root / "recording.csv").string());
    names.emplace_back("recording.csv");
  }
  return names;
}

}  // namespace drift
