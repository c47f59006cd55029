#include "analysis/blind/rivals/export_trials.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "analysis/blind/key.hpp"
#include "analysis/blind/session/seal.hpp"
#include "core/base/file_text.hpp"
#include "core/base/results/folder.hpp"

namespace drift::blind {
namespace {

namespace fs = std::filesystem;

constexpr const char* readme =
    "Recordings of a blind study of driftscope: in each something may be concealed that the "
    "nominal\n"
    "model (study.toml of its folder) leaves out, or nothing, or noise that is not as declared.\n"
    "Answer without opening `sealed`; key.sha256 is the SHA-256 of sealed/key.json, published "
    "first.\n"
    "The key says of every trial its stratum, the hidden terms and axes, sizes and numbers.\n";

std::string content(const fs::path& path) {
  return file_text(path).value_or("");
}

}  // namespace

std::size_t export_trials(const std::string& folder, const std::string& to) {
  const std::string key = open_sealed(folder, "key.json");
  const ResultsFolder results{to, "blind"};
  require_results_folder(results);
  std::size_t trials = 0;
  for (const KeyEntry& entry : read_key(key).entries) {
    const std::string name = fmt::format("trials/{:04}", entry.plan.number);
    const fs::path here = fs::path(folder) / name;
    write_files(results, {{name + "/study.toml", content(here / "study.toml")},
                          {name + "/recording.csv", content(here / "recording.csv")}});
    ++trials;
  }
  write_files(results, {{"README.txt", readme},
                        {"key.sha256", content(fs::path(folder) / "key.sha256")},
                        {"sealed/key.json", key}});
  return trials;
}

}  // namespace drift::blind
