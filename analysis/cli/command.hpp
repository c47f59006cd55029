#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/cli/study_arguments.hpp"
#include "core/base/check.hpp"

namespace drift::cli {

/// Where what was asked for goes: to standard output, or into files.
enum class Result { printed, in_files };

/// What the program knows of a command. Each command declares itself in its own file; commands.cpp
/// lists them all.
struct Command {
  std::string_view name, group, what, example;
  /// Adds the options to the command's part of the command line; what it returns runs the command
  /// with what was given. Errors are thrown; main() alone turns them into exit codes.
  std::function<std::function<ExitCode()>(CLI::App&)> add;
  /// Whether all that was asked for is written into files even where no option names them.
  Result result = Result::printed;
  /// What is said where the user stops it; ended with how to go on.
  const char* stopped =
      "stopped: nothing was stored, what was computed is lost; the same command begins anew\n";
};

/// The `add` of a command whose arguments are an A. They live as long as the command line, which
/// writes into them.
template <class A>
std::function<std::function<ExitCode()>(CLI::App&)> with_arguments(void (*add)(CLI::App&, A&),
                                                                   ExitCode (*run)(const A&)) {
  return [=](CLI::App& app) -> std::function<ExitCode()> {
    auto arguments = std::make_shared<A>();
    add(app, *arguments);
    return [=] { return run(*arguments); };
  };
}

/// Groups of the list that --help prints.
namespace group {
inline constexpr std::string_view recordings = "Recordings";
inline constexpr std::string_view plans = "Study files and plans";
inline constexpr std::string_view studies = "Monte Carlo studies";
inline constexpr std::string_view program = "The program";
}  // namespace group

// Options that several commands have.
void add_study(CLI::App& app, StudyArguments& study);
void add_progress(CLI::App& app, std::string& style);
/// --full, of a command that prints its answer in brief (answer.hpp).
void add_full(CLI::App& app);
/// --json, of a command whose answer has a document: it goes to standard output alone.
CLI::Option* add_json(CLI::App& app);
/// --output, of a file or folder.
CLI::Option* add_output(CLI::App& app, std::string& path, const std::string& what);
/// A results folder of `run`.
void add_folder(CLI::App& app, std::string& folder);

/// "driftscope 0.1.0 (commit)".
std::string version_line();

/// The check of an argument that is one of some names, which --help lists.
CLI::Validator one_of(std::vector<std::string_view> names);

inline constexpr std::uint64_t last_run = 999999999;  ///< monte_carlo.runs is at most 1e9
/// The check of an option that is a whole number.
std::function<std::string(std::string)> whole(std::uint64_t least, std::uint64_t most);

}  // namespace drift::cli
