#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "mc/study.hpp"

namespace drift::cli {

/// A command adds itself to the program: its options, and what it does when it is chosen. Results go
/// to stdout, everything else to stderr. Errors are thrown; main() alone turns them into exit codes.
using Action = std::function<ExitCode()>;
void add_check(CLI::App& app, Action& chosen);
void add_simulate(CLI::App& app, Action& chosen);
void add_identify(CLI::App& app, Action& chosen);
void add_terms(CLI::App& app, Action& chosen);
void add_version(CLI::App& app, Action& chosen);

/// What every command that reads a study file takes.
struct StudyArguments {
  std::string config;
  std::vector<std::string> sets;  ///< "key=value"
  std::optional<std::string> seed;
  int threads = 0;                ///< 0: all
  std::string progress = "auto";

  void add_to(CLI::App& command);
  /// Reads the study with the overrides of the command line.
  Study read() const;
};

}  // namespace drift::cli
