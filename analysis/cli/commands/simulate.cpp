#include "core/sim/simulate.hpp"

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/report/study/truth_memory.hpp"
#include "core/base/output_file.hpp"
#include "core/base/utf8.hpp"
#include "core/recording/recording_output.hpp"
#include "core/recording/rows/quality_card.hpp"
#include "mc/study/own_terms_on_plan.hpp"
#include "mc/study/simulated_surroundings.hpp"

namespace drift::cli {
namespace {

/// What a reader of the recording must know to repeat it.
void add_facts(Recording& recording, const mc::Study& study, std::uint64_t run) {
  recording.facts = {{std::string(made_here), study.title},
                     {"study", utf8_text(study.path)},
                     {"seed", std::to_string(study.monte_carlo.seed)},
                     {"run", std::to_string(run)},
                     {"random_numbers", Stream::scheme}};
}

ExitCode simulate(const StudyArguments& arguments, const std::string& output, std::uint64_t run) {
  const mc::Study study = arguments.read();
  if (study.kind == RecordingKind::strapdown)
    throw InputError(ExitCode::config,
                     fmt::format("{}: simulate makes recordings of platforms; [plan] has kind "
                                 "= \"strapdown\". Give a study of a platform",
                                 study.path));
  if (!study.has_truth)
    throw InputError(
        ExitCode::config,
        fmt::format("{}: no [truth] to simulate from. Add a section [truth]", study.path));
  if (study.truth.coupling == Coupling::compensated && study.truth.loop == LoopEstimate::feedback)
    throw InputError(
        ExitCode::config,
        fmt::format("{}: the loop of [truth] is fed back from a filter, so there is no recording "
                    "without one. Use `driftscope identify`, or truth.loop.estimate = \"given\"",
                    study.path));
  mc::require_simulable_truth(study);
  require_output_file(output, {study.path},
                      [](const std::string& path) { return not_made_here(path); });
  Timeline timeline = lay_out(study.plan, study.site);
  set_loop(timeline, study.truth);
  set_environment(timeline, study.environment, study.monte_carlo.seed, run);
  mc::resolve_own_terms(timeline, study);
  Simulator simulator(study.truth, study.readout);
  const Simulation sim = simulator.run(timeline, study.monte_carlo.seed, run);
  if (!sim.ode.ok())
    throw InputError(ExitCode::self_check,
                     fmt::format("run {} failed at t = {:.6g} s: {} ({})", run, sim.ode.t,
                                 name(sim.ode.status), sim.ode.cause));
  say("{}", report::truth_memory_text(study, run));
  Recording recording = make_recording(timeline, sim.measured, study.readout);
  add_facts(recording, study, run);
  write_recording(recording, output);
  recording.source = output;
  show("{}", to_text(quality_card(recording, RecordingKind::platform)));
  return ExitCode::ok;
}

}  // namespace

Command simulate_command() {
  struct Arguments {
    StudyArguments study;
    std::string output;
    std::uint64_t run = 0;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_study(app, a.study);
    add_output(app, a.output, "recording to write (.csv, .h5 or .mat)")->required();
    app.add_option("--run", a.run, "run number")->check(whole(0, last_run));
  };
  return {"simulate", group::plans, "one recording from the truth of a study file",
          "driftscope simulate configs/table1.toml -o recording.csv --run 3",
          with_arguments<Arguments>(
              add, [](const Arguments& a) { return simulate(a.study, a.output, a.run); })};
}

}  // namespace drift::cli
