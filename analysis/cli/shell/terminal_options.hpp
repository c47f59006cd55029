#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"

namespace drift::cli {

/// What every command takes beside its own options.
struct TerminalOptions {
  bool quiet = false;
  std::string color = "auto";  ///< auto, always, never
  int threads = 0;             ///< that work is spread over, where it can be; 0: all
};

/// Adds --quiet, --color and --threads.
void add_terminal_options(CLI::App& app, TerminalOptions& options);

/// Whether the command line asks for progress as JSON: then nothing else is on standard error, not
/// even what is wrong with the command line.
bool asks_for_json_lines(std::span<char* const> arguments);

/// What the terminal shows of a command that was given: with --quiet no remarks and no progress,
/// and no text on standard output where what was asked for is in files.
Terminal terminal_of(const TerminalOptions& options, const CLI::App& given, Result result);

}  // namespace drift::cli
