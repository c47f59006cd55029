#include "analysis/blind/session/answer_trials.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <new>
#include <nlohmann/json.hpp>

#include "analysis/blind/key.hpp"
#include "analysis/blind/session/counter.hpp"
#include "analysis/blind/session/crash_mark.hpp"
#include "analysis/blind/session/seal.hpp"
#include "core/base/check.hpp"
#include "core/base/file_text.hpp"

namespace drift::blind {
namespace {

namespace fs = std::filesystem;

fs::path trial_folder(const fs::path& folder, std::size_t number) {
  return folder / trial_name(number);
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

void answer_one(const Solver& solver, std::size_t number, const fs::path& folder) {
  const fs::path here = trial_folder(folder, number);
  const auto started = std::chrono::steady_clock::now();
  const auto crashes = crashes_in((here / "crashes").string());
  Answer answer = crashes.size() < most_crashes ? solved(solver, here) : given_up(crashes);
  answer.number = number;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  // Times are no answers: what is sealed is the same whenever and wherever it was found.
  const nlohmann::ordered_json time = {{"seconds", seconds}};
  write_files(results_in(folder), {{trial_name(number) + "/time.json", time.dump() + "\n"},
                                   {trial_name(number) + "/answer.json", to_json(answer)}});
  fs::remove(here / "crashes");
}

/// How long a diagnosis took, as far as that is known [s].
std::optional<double> seconds_of(const fs::path& folder, std::size_t number) {
  const auto text = file_text(trial_folder(folder, number) / "time.json");
  const auto json = nlohmann::json::parse(text.value_or(""), nullptr, false);
  if (!json.is_object() || !json.contains("seconds") || !json["seconds"].is_number())
    return std::nullopt;
  return json["seconds"].get<double>();
}

/// Of a folder whose key is sealed. InputError (store) if a trial is gone that has no answer yet:
/// the score would be that of fewer trials than the key is of.
std::size_t count_trials(const fs::path& folder) {
  const std::size_t trials = trials_asked(folder.string());
  for (std::size_t number = 1; number <= trials; ++number) {
    if (!is_answered(folder, number) && !is_there(folder, number))
      throw InputError(
          ExitCode::store,
          fmt::format(
              "{}: recording or study is gone (expected those of all {} trials that the sealed key "
              "is of). Put it back, or make it anew with `driftscope blind`: it comes out the same",
              trial_folder(folder, number).string(), trials));
  }
  return trials;
}

/// All answers in the order of the trials, or nothing while one is missing.
std::optional<std::vector<Answer>> all_answers(const fs::path& folder, std::size_t trials) {
  std::vector<Answer> all;
  for (std::size_t number = 1; number <= trials; ++number) {
    auto answer = kept_answer(folder, number);
    if (!answer) return std::nullopt;
    all.push_back(std::move(*answer));
  }
  return all;
}

}  // namespace

std::vector<std::size_t> unanswered(const std::string& folder, const mc::WorkerShare& share) {
  std::vector<std::size_t> missing;
  for (const std::size_t k : mc::own_part(count_trials(folder), share))
    if (!is_answered(folder, k + 1)) missing.push_back(k + 1);
  return missing;
}

std::optional<std::string> answer_trials(const std::string& folder, const Solver& solver,
                                         const mc::WorkSession& session, const Progress& progress) {
  if (published_hash(folder, "key.json").empty())
    throw InputError(ExitCode::self_check,
                     fmt::format("{}: the key is not sealed (expected key.sha256). Make the trials "
                                 "first",
                                 folder));
  const std::size_t trials = count_trials(folder);
  Counter counter(trials - unanswered(folder, {}).size(), trials, progress);
  mc::work_through(unanswered(folder, session.share), session, [&](std::size_t number) {
    if (!is_answered(folder, number)) answer_one(solver, number, folder);
    counter.step();
  });
  const auto answers = all_answers(folder, trials);
  if (!answers) return std::nullopt;
  return write_sealed(folder, "answers.json", to_json(*answers));
}

std::vector<TrialScore> score_folder(const std::string& folder) {
  auto answers = answers_of(open_sealed(folder, "answers.json"));
  for (Answer& a : answers) a.seconds = seconds_of(folder, a.number).value_or(a.seconds);
  return score_trials(read_key(open_sealed(folder, "key.json")).entries, answers);
}

}  // namespace drift::blind
