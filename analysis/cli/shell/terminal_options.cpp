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

bool asks_for_json_lines(std::span<char* const> arguments) {
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string_view word = arguments[k];
    if (word == "--progress=json") return true;
    if (word == "--progress" && k + 1 < arguments.size() &&
        std::string_view(arguments[k + 1]) == "json")
      return true;
  }
  return false;
}

Terminal terminal_of(const TerminalOptions& options, const CLI::App& given, Result result) {
  using enum Terminal::Shown;
  Terminal shown;
  shown.lines = terminal().lines;
  shown.details = has(given, "--full") ? yes : no;
  shown.json = has(given, "--json") ? yes : no;
  shown.colour = shows_colour(options.color) ? yes : no;
  if (!options.quiet) return shown;
  shown.remarks = no;
  shown.results = writes_files(given, result) ? no : yes;
  return shown;
}

}  // namespace drift::cli
