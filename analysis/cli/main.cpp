#include <CLI/CLI.hpp>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <system_error>

#include "analysis/cli/commands.hpp"

namespace {

using namespace drift;

/// The command line: the only source that knows CLI11.
class Program {
 public:
  Program() {
    app_.require_subcommand(1);
    app_.get_formatter()->column_width(34);

    CLI::App* check = command("check", "read a study file, print all values and where each came from, run nothing",
                              "driftscope check configs/table1.toml --set plan.dwell=\"20 min\"",
                              [this] { return cli::check(study_); });
    add_study(*check);

    CLI::App* simulate = command("simulate", "one recording from the truth of a study file",
                                 "driftscope simulate configs/table1.toml -o recording.csv --run 3",
                                 [this] { return cli::simulate(study_, output_, run_); });
    add_study(*simulate);
    simulate->add_option("-o,--output", output_, "recording to write (.csv, .h5 or .mat)")->required();
    simulate->add_option("--run", run_, "run number");

    CLI::App* identify = command("identify", "estimate the parameters of a recording, or of a simulated one",
                                 "driftscope identify configs/table1.toml -o out/table1",
                                 [this] { return cli::identify(study_, recordings_, output_, run_); });
    add_study(*identify);
    identify->add_option("recordings", recordings_, "recordings (.csv, .h5, .mat); none: simulated from [truth]");
    identify->add_option("-o,--output", output_, "folder for tables, pictures and report");
    identify->add_option("--run", run_, "run number of the simulated recording");
    identify->add_option("--progress", study_.progress, "auto, plain, json or none")
        ->check(CLI::IsMember({"auto", "plain", "json", "none"}));

    CLI::App* blind = command("blind", "make recordings with concealed effects, diagnose each without the key, then score",
                              "driftscope blind configs/blind_small.toml -o out/blind",
                              [this] { return cli::blind(study_, output_, trials_); });
    add_study(*blind);
    blind->add_option("-o,--output", output_, "folder for trials, key, answers and report; the same one resumes")->required();
    blind->add_option("--trials", trials_, "override blind.trials");
    blind->add_option("--progress", study_.progress, "auto, plain, json or none")
        ->check(CLI::IsMember({"auto", "plain", "json", "none"}));

    CLI::App* terms = command("terms", "list the physics terms, or explain one",
                              "driftscope terms gyro_misalignment", [this] { return cli::terms(key_); });
    terms->add_option("key", key_, "a term or a parameter");

    CLI::App* version = command("version", "program, libraries, compiler, instruction set",
                                "driftscope version --json", [this] { return cli::version(json_); });
    version->add_flag("--json", json_, "as JSON");
  }

  int run(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      return app_.exit(e) == 0 ? 0 : static_cast<int>(ExitCode::usage);
    }
    try {
      const ExitCode code = chosen_();
      if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category());
      return static_cast<int>(code);
    } catch (const std::system_error& e) {
      if (e.code() == std::errc::broken_pipe) return 128 + SIGPIPE;  // the reader has seen enough
      fmt::print(stderr, "error: standard output: {}. Results are incomplete; make room and run again\n", e.what());
      return static_cast<int>(ExitCode::io);
    } catch (const InputError& e) {
      std::fflush(stdout);
      for (const auto& message : e.messages()) fmt::print(stderr, "error: {}\n", message);
      return static_cast<int>(e.code());
    }
  }

 private:
  CLI::App* command(const char* name, const char* what, const char* example, std::function<ExitCode()> action) {
    CLI::App* c = app_.add_subcommand(name, what);
    c->footer(std::string("Example: ") + example);
    c->callback([this, action = std::move(action)] { chosen_ = action; });
    return c;
  }

  void add_study(CLI::App& c) {
    c.add_option("config", study_.config, "study file (TOML)")->required();
    c.add_option("--set", study_.sets, "override a value of the study file, e.g. plan.dwell=\"20 min\"")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    c.add_option("--seed", study_.seed, "override monte_carlo.seed");
    c.add_option("--threads", study_.threads, "number of threads; all by default")->check(CLI::Range(1, 4096));
  }

  CLI::App app_{"driftscope: Monte Carlo observability engine for gimballed inertial platforms"};
  std::function<ExitCode()> chosen_;
  cli::StudyArguments study_;
  std::string output_, key_;
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
  } catch (const std::exception& e) {
    std::fprintf(stderr, "internal error: %s\nThis is a bug in driftscope; please report it.\n", e.what());
    return static_cast<int>(drift::ExitCode::internal);
  }
}
