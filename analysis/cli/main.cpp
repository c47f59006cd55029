#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <functional>
#include <sstream>

#include "analysis/cli/argument_checks.hpp"
#include "analysis/cli/commands.hpp"
#include "analysis/cli/not_known.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/tell_error.hpp"

namespace {

using namespace drift;

/// The command line: the only source that knows CLI11.
class Program {
 public:
  Program() {
    app_.require_subcommand(1);
    app_.get_formatter()->column_width(34);
    app_.set_version_flag("--version", cli::version_line());

    CLI::App* check = command(
        "check", "read a study file, print all values and where each came from, run nothing",
        "driftscope check configs/table1.toml --set plan.dwell=\"20 min\"",
        [this] { return cli::check(study_); });
    add_study(*check);

    CLI::App* simulate = command("simulate", "one recording from the truth of a study file",
                                 "driftscope simulate configs/table1.toml -o recording.csv --run 3",
                                 [this] { return cli::simulate(study_, output_, run_); });
    add_study(*simulate);
    simulate->add_option("-o,--output", output_, "recording to write (.csv, .h5 or .mat)")
        ->required()
        ->check(cli::check_path);
    simulate->add_option("--run", run_, "run number")->check(whole(0, last_run));

    CLI::App* identify =
        command("identify", "estimate the parameters of a recording, or of a simulated one",
                "driftscope identify configs/table1.toml -o out/table1",
                [this] { return cli::identify(study_, recordings_, output_, run_); });
    add_study(*identify);
    identify->add_option("recordings", recordings_,
                         "recordings (.csv, .h5, .mat); none: simulated from [truth]");
    identify->add_option("-o,--output", output_, "folder for tables, pictures and report")
        ->check(cli::check_path);
    identify->add_option("--run", run_, "run number of the simulated recording")
        ->check(whole(0, last_run));
    add_progress(*identify);

    add_run();
    add_looks();

    add_rank();
    add_own_files();

    CLI::App* blind =
        command("blind",
                "make recordings with concealed effects, diagnose each without the key, then score",
                "driftscope blind configs/blind_small.toml -o out/blind",
                [this] { return cli::blind(study_, output_, trials_); });
    add_study(*blind);
    blind
        ->add_option("-o,--output", output_,
                     "folder for trials, key, answers and report; the same one resumes")
        ->required()
        ->check(cli::check_path);
    blind->add_option("--trials", trials_, "override blind.trials");
    add_progress(*blind);

    CLI::App* diagnose = command(
        "diagnose", "locate a mismatch, name the physics left out, model it, show the fit improve",
        "driftscope diagnose configs/diagnose_xsens.toml recording.csv -o out/diagnosis",
        [this] { return cli::diagnose(study_, recordings_, output_, advise()); });
    add_study(*diagnose);
    diagnose
        ->add_option("recordings", recordings_, "recordings of the study's plan (.csv, .h5, .mat)")
        ->required();
    diagnose
        ->add_option("-o,--output", output_,
                     "folder for diagnosis.json, report, pictures and patched.toml")
        ->check(cli::check_path);
    advise_option_ =
        diagnose
            ->add_option("--advise", advise_,
                         "which further positions would tell these terms apart and from the "
                         "nominal model; without terms: what the verdict suggests")
            ->type_name("[TERM,...]")
            ->expected(0, 1)
            ->check(cli::check_no_file);
    add_progress(*diagnose);

    CLI::App* terms =
        command("terms", "list the physics terms, or explain one",
                "driftscope terms gyro_misalignment", [this] { return cli::terms(key_); });
    terms->add_option("key", key_, "a term or a parameter");

    CLI::App* version =
        command("version", "program, libraries, compiler, instruction set",
                "driftscope version --json", [this] { return cli::version(json_); });
    version->add_flag("--json", json_, "as JSON");
  }

  int run(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      if (const std::string wrong = e.get_exit_code() == 0 ? "" : cli::not_known(app_, argc, argv);
          !wrong.empty()) {
        cli::say("error: {}\n", wrong);
        return static_cast<int>(ExitCode::usage);
      }
      std::ostringstream out, err;
      const int code = app_.exit(e, out, err);
      cli::show_text(out.str());
      cli::say_text(err.str());
      return code == 0 ? 0 : static_cast<int>(ExitCode::usage);
    }
    const ExitCode code = chosen_();
    cli::flush_output();
    return static_cast<int>(code);
  }

 private:
  std::optional<std::vector<std::string>> advise() const {
    if (advise_option_->count() == 0) return std::nullopt;
    return cli::list_of(advise_);
  }

  static std::function<std::string(std::string)> whole(std::uint64_t least, std::uint64_t most) {
    return [=](const std::string& text) { return cli::check_whole(text, least, most); };
  }

  CLI::App* command(const char* name, const char* what, const char* example,
                    std::function<ExitCode()> action) {
    CLI::App* c = app_.add_subcommand(name, what);
    c->footer(std::string("Example: ") + example);
    c->callback([this, action = std::move(action)] { chosen_ = action; });
    return c;
  }

  void add_rank() {
    CLI::App* rank =
        command("rank", "how observable each parameter is on a plan, and which positions to add",
                "driftscope rank configs/table1.toml --improve 3 --criterion eta_x -o out/rank",
                [this] { return cli::rank(study_, rank_); });
    add_study(*rank);
    CLI::Option* improve =
        rank->add_option("--improve", rank_.improve, "propose so many further positions")
            ->check(CLI::Range(1, 1000));
    rank->add_option(
            "--criterion", rank_.criterion,
            "what they make small: A (trace), D (determinant) or a parameter such as eta_x")
        ->needs(improve);
    rank->add_option("-o,--output", rank_.folder, "folder for rank.json, pictures and report")
        ->check(cli::check_path);
    rank->add_flag("--json", rank_.json, "rank.json on stdout instead of tables");
    add_progress(*rank);
  }

  void add_own_files() {
    CLI::App* convert =
        command("convert", "a recording of your own with the program's columns and units",
                "driftscope convert lab.toml log.txt -o recording.csv",
                [this] { return cli::convert(study_, recording_, output_); });
    add_study(*convert);
    convert->add_option("recording", recording_, "recording (.csv, .txt, .h5, .mat)")->required();
    convert->add_option("-o,--output", output_, "recording to write (.csv, .h5 or .mat)")
        ->required()
        ->check(cli::check_path);

    CLI::App* look =
        command("look", "what a file holds, and how to read it as a recording",
                "driftscope look log.txt", [this] { return cli::look(study_, recording_); });
    look->add_option("recording", recording_, "recording (.csv, .txt, .h5, .mat)")->required();
    look->add_option("config", study_.config, "study file (TOML) to read it with");
  }

  void add_progress(CLI::App& c) {
    c.add_option("--progress", study_.progress, "auto, plain, json or none")
        ->check(CLI::IsMember({"auto", "plain", "json", "none"}));
  }

  void add_run() {
    CLI::App* c = command("run", "the Monte Carlo study of a file; the same command again resumes",
                          "driftscope run configs/study.toml -o out/study --max-wall 55m",
                          [this] { return cli::run(study_, run_options_, cli::study_program()); });
    add_study(*c);
    add_progress(*c);
    c->add_option("-o,--output", run_options_.folder,
                  "results folder; results/<name of the study file> by default")
        ->check(cli::check_path);
    c->add_option("--runs", run_options_.runs,
                  "override monte_carlo.runs; more than before extends a study")
        ->check(whole(1, 1000000000));
    c->add_option("--worker", run_options_.worker,
                  "do part i of n of the study, i = 0 .. n - 1; auto: what Slurm, SGE or PBS says")
        ->type_name("I/N|auto");
    c->add_option("--max-wall", run_options_.max_wall,
                  "stop after this time, resumable: 55m, 1h30m")
        ->type_name("TIME");
    c->add_flag("--dry-run", run_options_.dry_run,
                "say what would be done and how long it takes, write nothing");
    c->add_flag("--fail-fast", run_options_.fail_fast, "stop at the first run that fails");
  }

  CLI::App* look(const char* name, const char* what, const char* example,
                 std::function<ExitCode()> action) {
    CLI::App* c = command(name, what, example, std::move(action));
    c->add_option("folder", folder_, "results folder of `run`")->required();
    return c;
  }

  void add_looks() {
    look("status", "how far a study is: runs, failures, sessions, disk",
         "driftscope status results/study",
         [this] { return cli::status(folder_, cli::study_program()); });

    CLI::App* verify = look(
        "verify", "check every checksum and execute some runs again",
        "driftscope verify results/study --sample 5%",
        [this] { return cli::verify(folder_, sample_, study_.threads, cli::study_program()); });
    verify->add_option("--sample", sample_, "share of the runs to execute again, 1% by default")
        ->type_name("SHARE");
    verify->add_option("--threads", study_.threads, "number of threads; all by default")
        ->check(CLI::Range(1, 4096));

    CLI::App* replay = look("replay", "execute one run again, bit for bit",
                            "driftscope replay results/study --run 17 --trace run17.csv", [this] {
                              return cli::replay(folder_, choice_, output_, cli::study_program());
                            });
    replay->add_option("--run", choice_.run, "run number")->required()->check(whole(0, last_run));
    replay->add_option("--point", choice_.point, "study point of a sweep, from 0")
        ->check(whole(0, last_run));
    replay->add_option("--trace", output_, "write the course of the run as CSV")
        ->check(cli::check_path);

    look("report", "the HTML report of a results folder; of a study made anew, finished or not",
         "driftscope report results/study",
         [this] { return cli::report(folder_, cli::study_program()); });

    CLI::App* exporter = look(
        "export", "convert the results", "driftscope export results/study --format hdf5",
        [this] { return cli::export_results(folder_, format_, output_, cli::study_program()); });
    exporter->add_option("--format", format_, "hdf5, csv or json")
        ->required()
        ->check(CLI::IsMember({"hdf5", "csv", "json"}));
    exporter
        ->add_option("-o,--output", output_,
                     "file to write; FOLDER/export.h5, .csv or .json by default")
        ->check(cli::check_path);
  }

  void add_study(CLI::App& c) {
    c.add_option("config", study_.config, "study file (TOML)")->required();
    c.add_option("--set", study_.sets,
                 "override a value of the study file, e.g. plan.dwell=\"20 min\"")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    c.add_option("--seed", study_.seed, "override monte_carlo.seed")->check(cli::check_seed);
    c.add_option("--threads", study_.threads, "number of threads; all by default")
        ->check(CLI::Range(1, 4096));
  }

  static constexpr std::uint64_t last_run = 999999999;  // monte_carlo.runs is at most 1e9

  CLI::App app_{"driftscope: Monte Carlo observability engine for gimballed inertial platforms"};
  std::function<ExitCode()> chosen_;
  cli::StudyArguments study_;
  cli::RankArguments rank_;
  cli::RunArguments run_options_;
  cli::RunChoice choice_;
  CLI::Option* advise_option_ = nullptr;
  std::string advise_;
  std::string output_, recording_, key_, folder_, format_, sample_ = "1%";
  std::vector<std::string> recordings_;
  std::uint64_t run_ = 0;
  std::optional<std::string> trials_;
  bool json_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an I/O error, not a crash
  try {
    return Program().run(argc, argv);
  } catch (...) {
    return cli::tell_error(std::current_exception());
  }
}
