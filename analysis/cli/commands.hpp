#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "mc/study.hpp"

namespace drift::cli {

/// What every command that reads a study file takes.
struct StudyArguments {
  std::string config;
  std::vector<std::string> sets;    ///< "key=value"
  std::optional<std::string> seed;
  int threads = 0;                  ///< 0: all
  std::string progress = "auto";    ///< auto, plain, json, none

  /// Reads the study with the overrides of the command line.
  Study read() const;
};

// The commands. Results go to stdout, everything else to stderr. Errors are thrown; main() alone
// turns them into exit codes.
ExitCode check(const StudyArguments& arguments);
ExitCode simulate(const StudyArguments& arguments, const std::string& output, std::uint64_t run);
ExitCode identify(const StudyArguments& arguments, const std::vector<std::string>& recordings,
                  const std::string& folder, std::uint64_t run);
ExitCode blind(const StudyArguments& arguments, const std::string& folder, const std::optional<std::string>& trials);
ExitCode terms(const std::string& key);
ExitCode version(bool json);

}  // namespace drift::cli
