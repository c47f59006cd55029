#include <filesystem>

#include "analysis/cli/answer.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/frozen_study.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/sharing.hpp"
#include "analysis/cli/study/dry_run.hpp"
#include "analysis/cli/study/run_progress.hpp"
#include "analysis/cli/study/run_words.hpp"
#include "analysis/cli/study/whole_results.hpp"
#include "analysis/cli/study_program.hpp"
#include "analysis/report/study/truth_memory.hpp"
#include "core/base/results/folder.hpp"
#include "core/base/words.hpp"
#include "mc/engine/engine.hpp"
#include "mc/export/export_text.hpp"
#include "mc/store/study_identity.hpp"
#include "mc/store/study_state.hpp"
#include "mc/study/study_notes.hpp"
#include "mc/task/campaign.hpp"

namespace drift::cli {
namespace {

/// What `run` takes beside a study.
struct RunArguments {
  std::string folder;  ///< empty: results/<name of the study file>
  std::optional<std::uint64_t> runs;
  Sharing sharing;
  bool dry_run = false;
  bool fail_fast = false;
};

std::string default_folder(const std::string& config) {
  return "results/" + std::filesystem::path(config).stem().string();
}

bool stopped(const mc::StudyOutcome& o) {
  return o.code == ExitCode::interrupted || o.code == ExitCode::terminated;
}

/// Where --max-wall is too short for the study.
void say_of_wall(const mc::StudyOutcome& o, const mc::EngineOptions& asked,
                 const std::string& folder, std::uint64_t executed) {
  if (o.code != ExitCode::wall_time || !asked.max_wall) return;
  if (executed == 0)
    say("{}: nothing was stored: not even one group of runs was finished in {}. Take a longer "
        "--max-wall, or more threads\n",
        folder, duration_text(o.seconds));
  else if (o.longest_group > *asked.max_wall)
    say("{}: runs that are executed together take {}, longer than --max-wall: the session ended "
        "after it, and a batch system may end it before. Take a longer --max-wall\n",
        folder, duration_text(o.longest_group));
}

/// What happened, for people; on stderr, where results are not.
void tell(const mc::StudyOutcome& o, const mc::EngineOptions& asked, const std::string& folder,
          const mc::Manifest& manifest) {
  const std::uint64_t executed = o.done + o.kept + o.dropped;
  if (stopped(o)) {
    say("stopped: {} runs are stored in {}, {} of unfinished blocks are kept{}; the same command "
        "goes on with the rest\n",
        o.done_before + o.done + o.taken_over, folder, o.kept_after,
        executed == 0 && o.missing_own > 0
            ? fmt::format(": not even one group of runs was finished in {}",
                          duration_text(o.seconds))
            : "");
    return;
  }
  const double rate = o.seconds > 0.0 ? static_cast<double>(executed) / o.seconds : 0.0;
  say("{}: {} runs{} stored before{}, {} executed in {} ({:.1f} runs/s), {} failed{}{}\n", folder,
      o.done_before + o.cut_short, o.stored_runs > asked.runs ? " of those asked for" : "",
      o.kept_before > 0 ? fmt::format(" and {} of unfinished blocks kept", o.kept_before) : "",
      o.done, duration_text(o.seconds), rate, o.failed_now,
      o.kept > 0 ? fmt::format("; {} more, of unfinished blocks, are kept", o.kept) : "",
      o.dropped > 0 ? fmt::format("; {} more, executed with one that failed, are not", o.dropped)
                    : "");
  say_of_wall(o, asked, folder, executed);
  if (o.cut_short > 0)
    say("{}: {} of the runs stored before were in blocks that the shorter study ended within; they "
        "were executed again with the rest of their blocks\n",
        folder, o.cut_short);
  say_asked_before(folder, o.stored_runs, asked.runs);
  say_empty_part(folder, asked.share, manifest, asked.runs);
  if (!o.complete && o.missing_own > 0)
    say("{}: missing: {}{}. The same command goes on with them\n", folder,
        blocks_text(o.missing_own), part_text(asked.share));
  if (!o.complete && o.missing > o.missing_own)
    say("{}: missing: {} of the other workers' parts. They, or `run` without --worker, go "
        "on with them\n",
        folder, blocks_text(o.missing - o.missing_own));
}

void say_failed(const std::string& folder, std::size_t point, const mc::Failure& f) {
  say("failed: point {}, run {}: {} at t = {:.6g} s: {}. Look closer: driftscope replay {} --run "
      "{}{}\n",
      point, f.run, mc::name(f.status), f.t, f.cause, shell_word(folder), f.run,
      point > 0 ? fmt::format(" --point {}", point) : "");
}

void list_failures(mc::StudyReader& reader, const mc::StopRules& rules, const std::string& folder) {
  constexpr std::size_t most = 5;
  std::size_t count = 0;
  reader.each_result(rules, [&](const mc::StoredBlock& b) {
    for (const mc::Failure& f : b.failures)
      if (++count <= most) say_failed(folder, b.block.point, f);
  });
  if (count > most)
    say("failed: ... and {} more; `driftscope export {} --format csv` has all, with status, "
        "t_failed and cause\n",
        count - most, shell_word(folder));
}

ExitCode run(const StudyArguments& arguments, const RunArguments& given,
             const StudyProgram& program) {
  mc::Overrides overrides = arguments.overrides();
  if (given.runs) overrides.emplace_back("monte_carlo.runs", std::to_string(*given.runs));
  const mc::Study study = mc::read_study(arguments.config, overrides);
  mc::EngineOptions options;
  options.runs = study.monte_carlo.runs;
  options.allowed_failures = study.monte_carlo.allowed_failures;
  options.share = given.sharing.share();
  options.max_wall = given.sharing.seconds();
  options.fail_fast = given.fail_fast;
  const mc::StudyWork work = program.work(study);
  mc::Manifest manifest = mc::make_manifest(mc::identity_of(study), study.text, work.points);
  manifest.runs = options.runs;
  const std::string folder = given.folder.empty() ? default_folder(arguments.config) : given.folder;
  mc::Ranks ranks;
  if (ranks.size() > 1 && !given.sharing.worker.empty())
    throw InputError(ExitCode::usage,
                     "--worker: mpirun shares out the work already (expected one or the other). "
                     "Leave out --worker");
  if (ranks.size() == 1)
    given.sharing.require_part(
        "Add --worker auto or a --worker i/n of its own to each, or start it with the "
        "mpirun "
        "of Open MPI or srun --mpi=pmix");
  require_results_folder({folder, "run"});
  if (ranks.leader()) say("{}{}", mc::idle_settings_text(study), mc::swept_sample_text(study));
  if (given.dry_run) return dry_run({work, manifest, folder, !given.runs}, options, ranks);
  mc::claim_folder(folder, manifest);
  if (!given.runs) options.runs = runs_to_go_on_to(folder, options.runs, ranks.leader());
  begin_results({folder, "run"});
  const std::string aside = ranks.leader() ? mend_study(folder, manifest) : "";
  if (!aside.empty())
    say("note: {}/study.toml was not that of the study: written anew, what was there is kept "
        "as {}\n",
        folder, aside);
  if (ranks.leader()) say("{}results go to {}\n", report::truth_memory_text(study, 0), folder);
  const mc::StudyOutcome outcome =
      mc::run_study(work, options, folder, manifest, ranks, run_progress(arguments.progress));
  if (outcome.failed_first)
    say_failed(folder, outcome.failed_first->point, outcome.failed_first->failure);
  for (const std::string& note : outcome.notes) say("note: {}\n", note);
  if (!outcome.leader) return outcome.code;
  tell(outcome, options, folder, manifest);
  if (stopped(outcome)) return outcome.code;  // one line; failures are listed when the study ends
  mc::StudyReader reader(folder);
  if (outcome.failed > 0) list_failures(reader, work.stop_rules, folder);
  if (outcome.code == ExitCode::failed_runs && !outcome.complete)
    say("stopped at a run that failed, as --fail-fast asks; its block is not stored. Without "
        "--fail-fast the same command goes on\n");
  else if (outcome.code == ExitCode::failed_runs)
    complain(
        "error: {} of the runs failed (allowed {}): what is left may be a biased choice. See "
        "why: driftscope status {}\n",
        outcome.failed, options.allowed_failures, shell_word(folder));
  if (!outcome.complete) return outcome.code;
  if (outcome.code == ExitCode::ok || outcome.code == ExitCode::failed_runs)
    program.present(study, work, reader, folder);
  require_read_again(folder, reader, "The report", outcome.results);
  show_beside_answer(fmt::format("runs {}, failed {} (allowed {})\nresults {}\n", outcome.results,
                                 outcome.failed, options.allowed_failures, outcome.digest));
  if (work.stop_rules)
    if (const std::string ended = mc::state_of(reader, work.stop_rules).ended_by_rule();
        !ended.empty())
      show_beside_answer(ended + "\n");
  return outcome.code;
}

}  // namespace

Command run_command() {
  struct Arguments {
    StudyArguments study;
    RunArguments run;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_study(app, a.study);
    add_progress(app, a.study.progress);
    add_full(app);
    CLI::Option* json = add_json(app);
    add_output(app, a.run.folder, "results folder; results/<name of the study file> by default");
    app.add_option("--runs", a.run.runs,
                   "override monte_carlo.runs; more than before extends a study")
        ->check(whole(1, 1000000000));
    add_sharing(app, a.run.sharing);
    app.add_flag("--dry-run", a.run.dry_run,
                 "say what would be done and how long it takes, write nothing")
        ->excludes(json);
    app.add_flag("--fail-fast", a.run.fail_fast, "stop at the first run that fails");
  };
  return {"run",
          group::studies,
          "the Monte Carlo study of a file; the same command again resumes",
          "driftscope run configs/study.toml -o out/study --max-wall 55m",
          with_arguments<Arguments>(
              add, [](const Arguments& a) { return run(a.study, a.run, study_program()); }),
          Result::in_files,
          "stopped: what is stored stays; the same command goes on with the rest\n"};
}

}  // namespace drift::cli
