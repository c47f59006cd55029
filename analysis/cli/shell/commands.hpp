#pragma once

#include <vector>

#include "analysis/cli/command.hpp"

namespace drift::cli {

/// Every command, in the order in which --help lists them.
std::vector<Command> commands();

}  // namespace drift::cli
