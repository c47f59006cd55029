#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <exception>

#include "analysis/cli/commands.hpp"

namespace {

using namespace drift;

int run(int argc, char** argv) {
  CLI::App app{"driftscope: Monte Carlo observability engine for gimballed inertial platforms"};
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  cli::Action chosen;
  cli::add_check(app, chosen);
  cli::add_simulate(app, chosen);
  cli::add_identify(app, chosen);
  cli::add_terms(app, chosen);
  cli::add_version(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);  // prints help to stdout, errors to stderr
    return code == 0 ? 0 : static_cast<int>(ExitCode::usage);
  }
  try {
    return static_cast<int>(chosen());
  } catch (const InputError& e) {
    for (const auto& message : e.messages()) spdlog::error("{}", message);
    return static_cast<int>(e.code());
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an I/O error, not a crash
#endif
  try {
    spdlog::set_default_logger(spdlog::stderr_color_mt("driftscope"));
    spdlog::set_pattern("%^%l%$: %v");
    return run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "internal error: %s\nThis is a bug in driftscope; please report it.\n", e.what());
    return static_cast<int>(drift::ExitCode::internal);
  }
}
