#include "analysis/blind/session/trial_folder.hpp"

#include <fmt/format.h>

#include "analysis/blind/answer.hpp"
#include "analysis/blind/session/seal.hpp"
#include "core/base/check.hpp"
#include "core/base/file_text.hpp"
#include "mc/store/manifest.hpp"
#include "mc/store/store.hpp"

namespace drift::blind {
namespace {

namespace fs = std::filesystem;

void require_same(const mc::Study& study, const fs::path& folder) {
  const auto held = file_text(folder / "study.toml");
  if (!held && fs::exists(folder / "key.json"))
    throw InputError(
        ExitCode::store,
        fmt::format("{}: holds a key but no study. Give an empty folder", folder.string()));
  if (held && *held != study.text)
    throw InputError(
        ExitCode::store,
        fmt::format("{}: holds the trials of another study (expected {} as it is now). "
                    "Give another folder, or remove it",
                    folder.string(), study.path));
}

/// What trials and answers depend on besides the program: every byte of study and recording.
mc::Manifest manifest_of(const TrialSource& source) {
  const mc::Study& study = source.study();
  mc::Manifest manifest =
      mc::make_manifest({source.identity(), study.monte_carlo.seed, 1}, study.text, {});
  manifest.runs = study.blind.all_trials();
  return manifest;
}

/// How many files dir/NNNN<name> there are, of the first so many numbers.
std::size_t count(const fs::path& dir, const std::string& name, std::size_t numbers) {
  std::size_t found = 0;
  for (std::size_t n = 1; n <= numbers; ++n)
    found += fs::exists(dir / fmt::format("{:04}{}", n, name));
  return found;
}

}  // namespace

ResultsFolder results_in(const fs::path& folder) {
  return {folder.string(), "blind"};
}

std::string trial_name(std::size_t number) {
  return fmt::format("trials/{:04}", number);
}

bool is_there(const fs::path& folder, std::size_t number) {
  const fs::path trial = folder / trial_name(number);
  return fs::exists(trial / "recording.csv") && fs::exists(trial / "study.toml");
}

bool is_answered(const fs::path& folder, std::size_t number) {
  return fs::exists(folder / trial_name(number) / "answer.json");
}

std::string worker_of_trials(const std::string& folder, std::size_t worker) {
  return mc::worker_path((fs::path(folder) / "trials").string(), worker);
}

void open_trials(const TrialSource& source, const std::string& folder) {
  source.require_usable();
  const mc::Study& study = source.study();
  require_same(study, folder);
  begin_results(results_in(folder));
  mc::claim_folder((fs::path(folder) / "trials").string(), manifest_of(source));
  if (!fs::exists(fs::path(folder) / "study.toml"))
    write_files(results_in(folder), {{"study.toml", study.text}});
}

std::optional<Answer> kept_answer(const fs::path& folder, std::size_t number) {
  const std::string path = (folder / trial_name(number) / "answer.json").string();
  const auto text = file_text(path);
  if (!text) return std::nullopt;
  return answer_of_json(*text, path);
}

std::size_t trials_asked(const std::string& folder) {
  const fs::path here(folder);
  if (results_of(folder) != "blind" || !fs::exists(here / "study.toml"))
    throw InputError(ExitCode::store,
                     fmt::format("{}: holds no trials (expected those of `driftscope blind`). Give "
                                 "the folder that was named with -o",
                                 folder));
  return mc::read_study((here / "study.toml").string()).blind.all_trials();
}

TrialsState trials_state(const std::string& folder) {
  const fs::path here(folder);
  TrialsState s;
  s.trials = trials_asked(folder);
  s.key_sealed = !published_hash(folder, "key.json").empty();
  if (!s.key_sealed) s.made = count(here / "making", ".json", s.trials);
  for (std::size_t n = 1; n <= s.trials; ++n) {
    const auto answer = kept_answer(here, n);
    s.answered += answer.has_value();
    s.failed += answer && answer->failed;
    s.made += s.key_sealed && (answer || is_there(here, n));
  }
  s.scored = !published_hash(folder, "answers.json").empty() && fs::exists(here / "blind.json");
  return s;
}

}  // namespace drift::blind
