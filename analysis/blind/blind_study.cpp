#include "analysis/blind/blind_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <new>

#include "analysis/blind/crash_mark.hpp"
#include "analysis/blind/design.hpp"
#include "analysis/blind/generate.hpp"
#include "analysis/blind/key.hpp"
#include "analysis/blind/seal.hpp"
#include "core/base/check.hpp"
#include "core/base/file_text.hpp"
#include "core/base/results_folder.hpp"
#include "core/recording/recording_output.hpp"
#include "mc/task/campaign.hpp"

namespace drift::blind {
namespace {

namespace fs = std::filesystem;

/// Within the folder of the study.
std::string trial_name(std::size_t number) {
  return fmt::format("trials/{:04}", number);
}

fs::path trial_folder(const fs::path& folder, std::size_t number) {
  return folder / trial_name(number);
}

ResultsFolder results_in(const fs::path& folder) {
  return {folder.string(), "blind"};
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
  if (file_text(folder / "study.toml") != study.text)
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
  const std::string name = trial_name(plan.number);
  const ResultsFolder results = results_in(folder);
  write_files(results, {{name + "/study.toml", nominal_text(study, plan)}});
  remove_result(results, name + "/answer.json");
  fs::remove(here / "crashes");
  MadeTrial made = make_trial(study, mc::read_study((here / "study.toml").string()), plan);
  write_result(results, name + "/recording.csv", [&](const std::string& temporary) {
    write_recording_to(made.recording, (here / "recording.csv").string(), temporary);
  });
  return std::move(made.key);
}

Answer given_up(const std::vector<std::string>& crashes) {
  Answer answer;
  answer.failed = true;
  answer.failure = fmt::format("the program crashed {} times while this trial was diagnosed ({})",
                               crashes.size(), fmt::join(crashes, ", "));
  return answer;
}

/// What the solver says, or why it says nothing. What is the machine's fault (a disk, memory) is no
/// answer: it ends the program, and the trial is diagnosed at the next call.
Answer solved(const Solver& solver, const fs::path& here) {
  const CrashMark mark((here / "crashes").string());
  Answer answer;
  try {
    return solver((here / "study.toml").string(), (here / "recording.csv").string());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const InputError& e) {
    if (e.code() == ExitCode::io) throw;
    answer.failure = e.what();
  } catch (const std::exception& e) {
    answer.failure = e.what();
  }
  answer.failed = true;
  return answer;
}

Answer answer_one(const Solver& solver, std::size_t number, const fs::path& folder) {
  constexpr std::size_t most_crashes = 2;
  const fs::path here = trial_folder(folder, number);
  const fs::path kept = here / "answer.json";
  if (const auto text = file_text(kept)) return answer_of_json(*text);
  const auto started = std::chrono::steady_clock::now();
  const auto crashes = crashes_in((here / "crashes").string());
  Answer answer = crashes.size() < most_crashes ? solved(solver, here) : given_up(crashes);
  answer.number = number;
  answer.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  write_files(results_in(folder), {{trial_name(number) + "/answer.json", to_json(answer)}});
  fs::remove(here / "crashes");
  return answer;
}

}  // namespace

std::string make_trials(const mc::Study& study, const std::string& folder, int threads,
                        const Progress& progress) {
  require_blind(study);
  if (already_made(study, folder)) return published_hash(folder, "key.json");
  write_files(results_in(folder), {{"study.toml", study.text}});
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
        Answer answer = answer_one(solver, k + 1, folder);
        counter.step();
        return answer;
      },
      threads);
  return write_sealed(folder, "answers.json", to_json(answers));
}

std::vector<TrialScore> score_folder(const std::string& folder) {
  const auto answers = answers_of(open_sealed(folder, "answers.json"));
  return score_trials(read_key(open_sealed(folder, "key.json")).entries, answers);
}

}  // namespace drift::blind
