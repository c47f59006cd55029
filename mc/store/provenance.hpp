#pragma once

#include <string>
#include <utility>
#include <vector>

namespace drift::mc {

/// Facts in the order in which they are shown.
using Facts = std::vector<std::pair<std::string, std::string>>;

/// With what results are computed: version, commit, compiler and flags, instruction set, libraries,
/// processor, operating system, host, command line, start in UTC.
Facts provenance();

/// "2026-11-21T09:51:03Z"
std::string utc_now();

}  // namespace drift::mc
