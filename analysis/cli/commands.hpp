#pragma once

#include <string>
#include <vector>

#include "analysis/cli/command.hpp"

namespace drift::cli {

/// Every command, in the order in which --help lists them.
std::vector<Command> commands();

/// "driftscope 0.1.0 (commit)".
std::string version_line();

}  // namespace drift::cli
