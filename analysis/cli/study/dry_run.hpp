#pragma once

#include <string>

#include "core/base/check.hpp"
#include "mc/engine/engine.hpp"

namespace drift::cli {

/// What `run` is asked to do, and where.
struct AskedRun {
  const mc::StudyWork& work;
  const mc::Manifest& manifest;
  const std::string& folder;
  bool goes_on = false;  ///< to as many runs as were asked for before: the command does not say
};

/// Says what the run would find in the folder, execute and take, from some runs tried in memory;
/// nothing is written. InputError: what the run itself would refuse.
ExitCode dry_run(const AskedRun& asked, mc::EngineOptions options, const mc::Ranks& ranks);

}  // namespace drift::cli
