#include "analysis/cli/shell/terminal_options.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "analysis/cli/command.hpp"

namespace drift::cli {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool shows_colour(const std::string& color) {
  if (color != "auto") return color == "always";
  const char* term = std::getenv("TERM");
  return isatty(STDOUT_FILENO) != 0 && !is_set("NO_COLOR") && term != nullptr &&
         std::string_view(term) != "dumb";
}

bool has(const CLI::App& app, const std::string& option) {
  const CLI::Option* known = app.get_option_no_throw(option);
  return known != nullptr && known->count() > 0;
}

bool writes_files(const CLI::App& app, Result result) {
  if (has(app, "--dry-run") || has(app, "--json")) return false;
  return result == Result::in_files || has(app, "--output") || has(app, "--trace");
}

}  // namespace

void add_terminal_options(CLI::App& app, TerminalOptions& options) {
  app.add_flag("--quiet", options.quiet,
               "print errors only, and what was asked for where no file takes it");
  app.add_option("--color", options.color, "auto (on a terminal, unless NO_COLOR), always or never")
      ->check(one_of({"auto", "always", "never"}));
  app.add_option("--threads", options.threads, "number of threads; all by default")
      ->check(CLI::Range(1, 4096));
}

Terminal terminal_of(const TerminalOptions& options, const CLI::App& given, Result result) {
  using enum Terminal::Shown;
  Terminal terminal;
  terminal.details = has(given, "--full") ? yes : no;
  terminal.colour = shows_colour(options.color) ? yes : no;
  if (!options.quiet) return terminal;
  terminal.remarks = no;
  terminal.results = writes_files(given, result) ? no : yes;
  return terminal;
}

}  // namespace drift::cli
