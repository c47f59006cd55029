#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/cli/study_program.hpp"
#include "core/base/check.hpp"
#include "mc/study/study.hpp"

namespace drift::cli {

/// What every command that reads a study file takes.
struct StudyArguments {
  std::string config;
  std::vector<std::string> sets;  ///< "key=value"
  std::optional<std::string> seed;
  int threads = 0;                ///< 0: all
  std::string progress = "auto";  ///< auto, plain, json, none

  /// Reads the study with the overrides of the command line.
  mc::Study read() const;
  mc::Overrides overrides() const;
};

/// What `run` takes besides.
struct RunArguments {
  std::string folder;  ///< empty: results/<name of the study file>
  std::optional<std::uint64_t> runs;
  std::string worker;    ///< "i/n"
  std::string max_wall;  ///< "55m"
  bool dry_run = false;
  bool fail_fast = false;
};

/// Which run of which study point.
struct RunChoice {
  std::uint64_t run = 0;
  std::size_t point = 0;
};

/// What `rank` takes besides.
struct RankArguments {
  std::size_t improve = 0;      ///< positions to propose
  std::string criterion = "A";  ///< A, D or a parameter
  std::string folder;           ///< empty: nothing is written
  bool json = false;            ///< rank.json on stdout instead of tables
};

/// A list with one more at its end.
inline std::vector<std::string> with(std::vector<std::string> list, const std::string& more) {
  list.push_back(more);
  return list;
}

// The commands. Results go to stdout, everything else to stderr. Errors are thrown; main() alone
// turns them into exit codes.
ExitCode check(const StudyArguments& arguments);
ExitCode simulate(const StudyArguments& arguments, const std::string& output, std::uint64_t run);
ExitCode identify(const StudyArguments& arguments, const std::vector<std::string>& recordings,
                  const std::string& folder, std::uint64_t run);
ExitCode blind(const StudyArguments& arguments, const std::string& folder,
               const std::optional<std::string>& trials);
ExitCode rank(const StudyArguments& arguments, const RankArguments& options);
ExitCode run(const StudyArguments& arguments, const RunArguments& options,
             const StudyProgram& program);
ExitCode status(const std::string& folder, const StudyProgram& program);
ExitCode verify(const std::string& folder, const std::string& sample, int threads,
                const StudyProgram& program);
ExitCode replay(const std::string& folder, const RunChoice& choice, const std::string& trace,
                const StudyProgram& program);
ExitCode export_results(const std::string& folder, const std::string& format,
                        const std::string& output, const StudyProgram& program);
ExitCode report(const std::string& folder, const StudyProgram& program);
/// advise: terms to be told apart by further positions; empty: what the verdict suggests; not
/// given: only where the verdict needs it.
ExitCode diagnose(const StudyArguments& arguments, const std::vector<std::string>& recordings,
                  const std::string& folder, const std::optional<std::vector<std::string>>& advise);
/// Writes the recording with the program's own columns and units.
ExitCode convert(const StudyArguments& arguments, const std::string& recording,
                 const std::string& output);
/// Says what a file holds, with a study file or with none (config empty).
ExitCode look(const StudyArguments& arguments, const std::string& recording);
ExitCode terms(const std::string& key);
ExitCode version(bool json);
/// "driftscope 0.1.0 (commit)".
std::string version_line();

}  // namespace drift::cli
