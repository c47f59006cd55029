#include <malloc.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <span>
#include <sstream>

#include "analysis/cli/print.hpp"
#include "analysis/cli/shell/commands.hpp"
#include "analysis/cli/shell/not_known.hpp"
#include "analysis/cli/shell/tell_error.hpp"
#include "analysis/cli/shell/terminal_options.hpp"
#include "analysis/cli/stop_at_once.hpp"
#include "mc/task/campaign.hpp"

namespace {

using namespace drift;

/// The command line of all commands.
class Program {
 public:
  Program() {
    app_.require_subcommand(1);
    app_.get_formatter()->column_width(34);
    app_.set_version_flag("--version", cli::version_line());
    cli::add_terminal_options(app_, terminal_);
    for (const cli::Command& command : cli::commands()) add(command);
  }

  int run(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      if (const std::string wrong = e.get_exit_code() == 0 ? "" : cli::not_known(app_, argc, argv);
          !wrong.empty()) {
        cli::complain("error: {}\n", wrong);
        return static_cast<int>(ExitCode::usage);
      }
      std::ostringstream out, err;
      const int code = app_.exit(e, out, err);
      cli::show_text(out.str());
      cli::complain_text((code != 0 ? "error: " : "") + err.str());
      if (code != 0)
        for (const CLI::App* chosen : app_.get_subcommands())
          cli::complain("{}\n", chosen->get_footer());
      cli::flush_output();
      return code == 0 ? 0 : static_cast<int>(ExitCode::usage);
    }
    const ExitCode code = chosen_();
    cli::flush_output();
    return static_cast<int>(code);
  }

 private:
  void add(const cli::Command& command) {
    CLI::App* app = app_.add_subcommand(std::string(command.name), std::string(command.what));
    app->group(std::string(command.group));
    app->footer(fmt::format("Example: {}", command.example));
    app->callback(
        [this, app, run = command.add(*app), result = command.result, stopped = command.stopped] {
          cli::set_terminal(cli::terminal_of(terminal_, *app, result));
          chosen_ = [this, run, stopped] {
            const cli::StopAtOnce stop(stopped);
            const mc::ThreadCount threads(terminal_.threads);
            return run();
          };
        });
    cli::add_terminal_options(*app, terminal_);
  }

  CLI::App app_{
      "driftscope: Monte Carlo observability engine for gimballed platforms and strapdown "
      "units"};
  cli::TerminalOptions terminal_;
  std::function<ExitCode()> chosen_;
};

/// Matrices of a megabyte come and go by the thousand. glibc gives each back to the kernel, which
/// clears it anew: one part in twelve of a diagnosis. What was used is kept for the next.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int megabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * megabyte);  // the largest that it takes
  mallopt(M_TRIM_THRESHOLD, 512 * megabyte);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an I/O error, not a crash
  try {
    const std::span<char* const> arguments(argv, static_cast<std::size_t>(argc));
    cli::set_arguments(arguments);
    cli::Terminal terminal;
    if (cli::asks_for_json_lines(arguments)) terminal.lines = cli::Terminal::Lines::json;
    cli::set_terminal(terminal);
    return Program().run(argc, argv);
  } catch (...) {
    return cli::tell_error(std::current_exception());
  }
}
