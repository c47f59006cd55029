#include <mutex>

#include "analysis/blind/rivals/export_trials.hpp"
#include "analysis/blind/rivals/score_rivals.hpp"
#include "analysis/blind/session/answer_trials.hpp"
#include "analysis/blind/session/diagnosing_solver.hpp"
#include "analysis/blind/session/make_trials.hpp"
#include "analysis/cli/answer.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/read_recordings.hpp"
#include "analysis/cli/sharing.hpp"
#include "analysis/cli/stop_at_once.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/blind/report.hpp"
#include "core/base/results/folder.hpp"
#include "mc/store/worker_lock.hpp"

namespace drift::cli {
namespace {

/// What others have to do with the trials.
struct Others {
  std::string export_to;  ///< folder for whoever wants to answer them; empty: none
  bool rivals = false;    ///< simple methods answer them beside the diagnosis

  bool need_recordings() const { return rivals || !export_to.empty(); }
};

/// What `blind` takes beside a study.
struct BlindArguments {
  std::string folder;
  std::optional<std::string> trials;
  std::optional<std::string> recording;  ///< that effects are hidden in; else trials are simulated
  Sharing sharing;
  Others others;
};

void export_for(const Others& others, const std::string& folder) {
  if (others.export_to.empty()) return;
  const std::size_t trials = blind::export_trials(folder, others.export_to);
  say("{} trials for others in {}, the key apart in {}/sealed\n", trials, others.export_to,
      others.export_to);
}

std::vector<blind::RivalScore> rivals_of(const Others& others, const std::string& folder) {
  if (!others.rivals) return {};
  return blind::score_rivals(folder, inference::SearchLimits::alpha, 0);
}

/// What is said where the diagnoses are stopped.
std::string stopped_text(const std::string& folder, std::size_t done, std::size_t total) {
  return fmt::format(
      "stopped: {} of {} trials are answered and kept in {}, those at work are lost; the same "
      "command goes on with the rest\n",
      done, total, folder);
}

/// Where a session ends before all is answered: the rest is this worker's, if its time was over, or
/// that of the others.
ExitCode tell_unfinished(const std::string& folder, const mc::WorkerShare& share) {
  const blind::TrialsState state = blind::trials_state(folder);
  if (!state.key_sealed) {
    say("{}: {} of {} trials are made, the time is over. The same command goes on\n", folder,
        state.made, state.trials);
    return ExitCode::wall_time;
  }
  say("{}: {} of {} trials are answered\n", folder, state.answered, state.trials);
  const std::size_t own = blind::unanswered(folder, share).size();
  const std::size_t others = blind::unanswered(folder, {}).size() - own;
  if (own > 0)
    say("{}: missing: {} trials{}. The same command goes on with them\n", folder, own,
        share.count > 1 ? fmt::format(" of this worker's part {}/{}", share.index, share.count)
                        : "");
  if (others > 0)
    say("{}: missing: {} trials of the other workers' parts. They, or `blind` without --worker, go "
        "on with them\n",
        folder, others);
  return own > 0 ? ExitCode::wall_time : ExitCode::ok;
}

/// Scores what is answered, writes and shows it.
ExitCode present(const mc::Study& study, report::BlindResults results, const std::string& folder,
                 const Others& others) {
  say("Answers sealed: SHA-256 {}\n", results.answers_hash);
  results.scores = blind::score_folder(folder);
  results.summary = blind::summarise(results.scores);
  results.rivals = rivals_of(others, folder);
  const report::Report said =
      with_provenance(report::blind_report(results), report::provenance_of(study.path, {}));
  show_answer(said.brief, {report::to_text(said), folder, report::write_report(said, folder),
                           said.document.second});
  say("A diagnosis took {:.3g} s on average, the longest {:.3g} s\n", results.summary.mean_seconds,
      results.summary.longest_seconds);
  for (const blind::TrialScore& score : results.scores)
    if (score.answer.failed)
      say("Trial {} has no answer: {}\n", score.key.plan.number, score.answer.failure);
  return results.summary.failed > study.monte_carlo.allowed_failures ? ExitCode::failed_runs
                                                                     : ExitCode::ok;
}

ExitCode blind(const StudyArguments& arguments, const BlindArguments& given) {
  StudyArguments all = arguments;
  if (given.trials) all.sets.push_back("blind.trials=" + *given.trials);
  const std::string& folder = given.folder;
  const mc::WorkSession session = given.sharing.session();
  given.sharing.require_part(
      "Start it once, or add --worker auto or a --worker i/n of its own to each");
  const mc::Study study = all.read();
  require_results_folder({folder, "blind"});
  std::vector<Recording> recordings;
  if (given.recording) recordings = read_recordings(study, {*given.recording});
  const blind::TrialSource source(study, given.recording ? &recordings.front() : nullptr);
  if (given.recording && given.others.rivals)
    throw InputError(ExitCode::usage,
                     "--rivals: they answer trials of a platform alone (expected no recording). "
                     "Leave it out");
  require_results_folder({given.others.export_to, "blind"});  // before hours of work for it
  blind::open_trials(source, folder);
  const mc::WorkerLock lock(blind::worker_of_trials(folder, session.share.index),
                            mc::worker_patience);
  report::BlindResults results;
  results.title = study.title;
  const auto key = blind::make_trials(source, folder, session,
                                      progress_reporter(arguments.progress, "recordings"));
  if (!key) return tell_unfinished(folder, session.share);
  results.key_hash = *key;
  say("Key sealed in {}: SHA-256 {}\n", folder, results.key_hash);
  blind::restore_trials(source, folder, given.others.need_recordings());
  export_for(given.others, folder);
  StopAtOnce stop("");
  const auto progress = progress_reporter(arguments.progress, "diagnoses");
  std::mutex guard;
  const auto answered = [&](std::size_t done, std::size_t total) {
    if (progress) progress(done, total);
    const std::scoped_lock words(guard);
    stop.say(stopped_text(folder, done, total));
  };
  const std::size_t trials = study.blind.all_trials();
  answered(trials - blind::unanswered(folder, {}).size(), trials);
  const auto answers = blind::answer_trials(folder, blind::diagnosing_solver(), session, answered);
  if (!answers) return tell_unfinished(folder, session.share);
  results.answers_hash = *answers;
  return present(study, std::move(results), folder, given.others);
}

}  // namespace

Command blind_command() {
  struct Arguments {
    StudyArguments study;
    BlindArguments blind;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_study(app, a.study);
    app.add_option("recording", a.blind.recording,
                   "recording of a strapdown unit that effects are hidden in; without one, trials "
                   "of a platform are simulated");
    add_output(app, a.blind.folder,
               "folder for trials, key, answers and report; the same one resumes")
        ->required();
    app.add_option("--trials", a.blind.trials, "override blind.trials");
    add_sharing(app, a.blind.sharing);
    app.add_option("--export", a.blind.others.export_to,
                   "folder for whoever wants to answer: recordings and nominal studies, key apart")
        ->type_name("DIR");
    app.add_flag("--rivals", a.blind.others.rivals, "score simple methods on the same trials too");
    add_progress(app, a.study.progress);
    add_full(app);
    add_json(app);
  };
  return {
      "blind",
      group::studies,
      "make recordings with concealed effects, diagnose each without the key, then score",
      "driftscope blind configs/blind_small.toml -o out/blind",
      with_arguments<Arguments>(add, [](const Arguments& a) { return blind(a.study, a.blind); }),
      Result::in_files,
      "stopped: nothing is answered yet; the same command goes on with the rest\n"};
}

}  // namespace drift::cli
