#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace drift::cli {

/// An option of a command, for a shell that completes it.
struct CompletedOption {
  std::vector<std::string> names;  ///< "-o", "--output"
  std::string what;
  bool takes_value = false;
  std::vector<std::string> values;  ///< all it takes; none: a file, or anything
};

/// A command, for a shell that completes it.
struct CompletedCommand {
  std::string name, what;
  std::vector<CompletedOption> options;
  std::vector<std::string> values;  ///< what its arguments may be; none: files
};

/// What the command line has: its own options under the empty name, then every command.
std::vector<CompletedCommand> completed_commands(const CLI::App& program);

// The script that makes a shell complete the program's command line.
std::string bash_completion(const std::vector<CompletedCommand>& commands);
std::string zsh_completion(const std::vector<CompletedCommand>& commands);
std::string fish_completion(const std::vector<CompletedCommand>& commands);

}  // namespace drift::cli
