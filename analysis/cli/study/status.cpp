#include <algorithm>
#include <filesystem>
#include <span>

#include "analysis/blind/session/seal.hpp"
#include "analysis/blind/session/trial_folder.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/frozen_study.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/study/megabytes.hpp"
#include "analysis/cli/study_program.hpp"
#include "analysis/planning/shared_steps.hpp"
#include "core/base/results/folder.hpp"
#include "mc/store/study_state.hpp"
#include "mc/store/worker_lock.hpp"

namespace drift::cli {
namespace {

/// What a batch system asks before the last job of a study: 75, as a run that stopped in time.
ExitCode code_of(bool complete) {
  return complete ? ExitCode::ok : ExitCode::wall_time;
}

std::string fact(const mc::Session& s, std::string_view key) {
  for (const auto& [k, value] : s.facts)
    if (k == key) return value;
  return "?";
}

/// `later`: of the sessions after it. A process works on a worker's file alone: of several sessions
/// without an end the last may be at work.
std::string ending(const mc::Session& s, std::span<const mc::Session> later) {
  if (!s.ended_utc.empty())
    return fmt::format("ended {} with exit code {}", s.ended_utc, s.exit_code);
  const std::string file = fact(s, "file");
  const bool is_last = std::ranges::none_of(
      later, [&](const mc::Session& other) { return fact(other, "file") == file; });
  switch (is_last ? mc::is_at_work(file) : mc::AtWork::no) {
    case mc::AtWork::yes:
      return "at work";
    case mc::AtWork::no:
      return "killed";
    case mc::AtWork::unknown:
      break;
  }
  return "at work, or killed: it cannot be told from here";
}

ExitCode status_of_study(const std::string& folder, const StudyProgram& program) {
  mc::StudyReader reader(folder);
  const auto [study, work] = frozen_study(folder, reader, program);
  const mc::StudyState state = mc::state_of(reader, work.stop_rules);
  const std::uint64_t total = state.asked * state.points.size();
  show("{}: {} of {} runs, {} failed, {} of {} points complete\n", folder, state.runs, total,
       state.failed, state.complete, state.points.size());
  if (state.by_rule > 0) show("{}\n", state.ended_by_rule());
  show("point       runs              failed            label\n");
  std::uint64_t left = 0;
  double cpu = 0.0;
  for (std::size_t p = 0; p < state.points.size(); ++p) {
    const mc::PointState& s = state.points[p];
    show("{:>5}  {:>9} / {:<9} {:>7}  {:<9} {}\n", p, s.runs, state.asked, s.failed,
         s.complete ? s.by_rule && s.runs < state.asked ? "stop rule" : "complete" : "",
         reader.manifest().points[p].label);
    if (!s.complete) left += state.asked - s.runs;
    cpu += s.cpu_s;
  }
  if (left > 0 && state.runs > 0)
    show("at most {} of CPU time to go\n",
         duration_text(cpu / static_cast<double>(state.runs) * static_cast<double>(left)));
  const auto kept =
      reader.kept([&](std::size_t point, std::uint64_t) { return !state.points[point].complete; });
  if (!kept.empty())
    show("and {} of unfinished blocks are kept: the same command goes on from them\n",
         mc::runs_of(kept));
  show("disk {:.3g} MB in {} worker files\n", megabytes_of(reader.files()), reader.files().size());
  const std::vector<mc::Session> sessions = reader.sessions();
  for (std::size_t k = 0; k < sessions.size(); ++k)
    show("session {} on {}, {}: {}\n", sessions[k].started_utc, fact(sessions[k], "host"),
         std::filesystem::path(fact(sessions[k], "file")).filename().string(),
         ending(sessions[k], std::span(sessions).subspan(k + 1)));
  for (const std::string& note : reader.notes()) show("damage: {}\n", note);
  if (state.lost > 0) show("lost: {}\n", state.was_complete());
  return code_of(state.all());
}

ExitCode status_of_trials(const std::string& folder) {
  const blind::TrialsState s = blind::trials_state(folder);
  for (const char* sealed : {"key.json", "answers.json"})  // a changed one is no result
    if (!blind::published_hash(folder, sealed).empty()) blind::open_sealed(folder, sealed);
  show("{}: {} of {} trials made, {}; {} answered, {} of them without a diagnosis; {}\n", folder,
       s.made, s.trials, s.key_sealed ? "the key is sealed" : "the key is not sealed yet",
       s.answered, s.failed, s.scored ? "scored" : "not scored yet");
  return code_of(s.complete());
}

ExitCode status_of_ranking(const std::string& folder) {
  namespace fs = std::filesystem;
  const bool written = fs::exists(fs::path(folder) / "rank.json");
  if (!fs::exists(planning::steps_folder(folder))) {
    show("{}: {}\n", folder, written ? "ranked" : "nothing is ranked yet");
    return code_of(written);
  }
  const mc::StudyState state = planning::steps_state(folder);
  const bool complete = written && state.finished > 0;
  show("{}: {} of {} positions to add are chosen, {} candidates judged; {}\n", folder,
       state.complete, state.points.size(), state.runs,
       complete ? "the results are written" : "the results are not written yet");
  return code_of(complete);
}

ExitCode status(const std::string& folder) {
  if (results_of(folder) == "blind") return status_of_trials(folder);
  if (results_of(folder) == "rank") return status_of_ranking(folder);
  return status_of_study(folder, study_program());
}

}  // namespace

Command status_command() {
  const auto add_shared_folder = [](CLI::App& app, std::string& folder) {
    app.add_option("folder", folder, "results folder of `run`, `blind` or `rank --improve`")
        ->required();
  };
  return {"status", group::studies,
          "how far the work in a folder is: runs or trials, failures, sessions, disk",
          "driftscope status results/study",
          with_arguments<std::string>(add_shared_folder, status)};
}

}  // namespace drift::cli
