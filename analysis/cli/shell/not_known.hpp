#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drift::cli {

/// The first command or option of the line that does not exist, with what may be meant; empty if
/// all do.
std::string not_known(const CLI::App& app, int argc, char** argv);

}  // namespace drift::cli
