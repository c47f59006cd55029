#include "analysis/blind/blind_study.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "analysis/blind/design.hpp"
#include "analysis/blind/generate.hpp"
#include "analysis/blind/key.hpp"
#include "analysis/blind/seal.hpp"
#include "core/base/check.hpp"
#include "core/base/results_folder.hpp"
#include "core/recording/recording.hpp"
#include "mc/task/campaign.hpp"

namespace drift::blind {
namespace {

namespace fs = std::filesystem;

fs::path trial_folder(const fs::path& folder, std::size_t number) {
  return folder / "trials" / fmt::format("{:04}", number);
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void require_blind(const mc::Study& study) {
  const auto refuse = [&](const std::string& text) {
    throw InputError(ExitCode::config, fmt::format("{}: {}", study.path, text));
  };
  if (!study.has_blind) refuse("no [blind] (expected which trials to make). Add a section [blind]");
  if (!study.has_truth) refuse("no [truth] to make recordings from. Add a section [truth]");
  if (study.filters.empty())
    refuse("no [[filter]]: a blind study needs a nominal one. Add a section [[filter]]");
  if (study.kind != RecordingKind::platform || study.plan.preset.empty())
    refuse(
        "[plan] has no preset (expected one, to be replaced by those of blind.plans). Write preset "
        "= \"twelve\"");
}

/// Tells progress, from any thread.
class Counter {
 public:
  Counter(std::size_t total, const Progress& progress) : total_(total), progress_(progress) {}
  void step() {
    const std::size_t done = ++done_;
    if (progress_) progress_(done, total_);
  }

 private:
  std::size_t total_;
  const Progress& progress_;
  std::atomic<std::size_t> done_{0};
};

/// True if the folder holds this study, with its key sealed.
bool already_made(const mc::Study& study, const fs::path& folder) {
  if (!fs::exists(folder / "study.toml")) {
    if (fs::exists(folder / "key.json"))
      throw InputError(
          ExitCode::store,
          fmt::format("{}: holds a key but no study. Give an empty folder", folder.string()));
    return false;
  }
  if (contents(folder / "study.toml") != study.text)
    throw InputError(
        ExitCode::store,
        fmt::format("{}: holds the trials of another study (expected {} as it is now). "
                    "Give another folder, or remove it",
                    folder.string(), study.path));
  if (published_hash(folder.string(), "key.json").empty()) return false;
  open_sealed(folder.string(), "key.json");
  return true;
}

KeyEntry make_one(const mc::Study& study, const TrialPlan& plan, const fs::path& folder) {
  const fs::path here = trial_folder(folder, plan.number);
  write_files({{"study.toml", nominal_text(study, plan)}}, here.string());
  for (const char* old : {"answer.json", "attempts"}) fs::remove(here / old);
  MadeTrial made = make_trial(study, mc::read_study((here / "study.toml").string()), plan);
  write_recording(made.recording, (here / "recording.csv").string());
  return std::move(made.key);
}

/// How often this trial was begun, this time included.
int begin_attempt(const fs::path& here) {
  const std::string before = contents(here / "attempts");
  const int attempt = static_cast<int>(before.size()) + 1;
  write_text_atomically((here / "attempts").string(),
                        std::string(static_cast<std::size_t>(attempt), '|'));
  return attempt;
}

Answer answer_one(const Solver& solver, std::size_t number, const fs::path& here) {
  constexpr int most_attempts = 2;
  const fs::path kept = here / "answer.json";
  if (fs::exists(kept)) return answer_of_json(contents(kept));
  const auto started = std::chrono::steady_clock::now();
  Answer answer;
  if (begin_attempt(here) > most_attempts) {
    answer.failed = true;
    answer.failure = "the program ended twice while this trial was diagnosed";
  } else {
    try {
      answer = solver((here / "study.toml").string(), (here / "recording.csv").string());
    } catch (const std::exception& e) {
      answer = {};
      answer.failed = true;
      answer.failure = e.what();
    }
  }
  answer.number = number;
  answer.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  write_text_atomically(kept.string(), to_json(answer));
  fs::remove(here / "attempts");
  return answer;
}

}  // namespace

std::string make_trials(const mc::Study& study, const std::string& folder, int threads,
                        const Progress& progress) {
  require_blind(study);
  if (already_made(study, folder)) return published_hash(folder, "key.json");
  write_files({{"study.toml", study.text}}, folder);
  const std::vector<TrialPlan> plans = design_trials(study.blind, study.monte_carlo.seed);
  Counter counter(plans.size(), progress);
  Key key{salt_of(study.monte_carlo.seed), {}};
  key.entries = mc::run_campaign(
      plans.size(),
      [&](std::size_t k) {
        KeyEntry entry = make_one(study, plans[k], folder);
        counter.step();
        return entry;
      },
      threads);
  return write_sealed(folder, "key.json", to_json(key));
}

std::string answer_trials(const std::string& folder, const Solver& solver, int threads,
                          const Progress& progress) {
  if (published_hash(folder, "key.json").empty())
    throw InputError(ExitCode::self_check,
                     fmt::format("{}: the key is not sealed (expected key.sha256). Make the trials "
                                 "first",
                                 folder));
  std::size_t trials = 0;
  while (fs::exists(trial_folder(folder, trials + 1) / "recording.csv")) ++trials;
  Counter counter(trials, progress);
  const auto answers = mc::run_campaign(
      trials,
      [&](std::size_t k) {
        Answer answer = answer_one(solver, k + 1, trial_folder(folder, k + 1));
        counter.step();
        return answer;
      },
      threads);
  return write_sealed(folder, "answers.json", to_json(answers));
}

std::vector<TrialScore> score_folder(const std::string& folder) {
  const auto answers = answers_of(open_sealed(folder, "answers.json"));
  return score_trials(key_of(open_sealed(folder, "key.json")).entries, answers);
}

}  // namespace drift::blind
