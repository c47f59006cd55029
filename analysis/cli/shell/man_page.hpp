#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drift::cli {

/// The manual page of the program, in the language of man(7), made from what `help` prints: every
/// command, argument and option in the same words.
std::string man_page(const CLI::App& program);

}  // namespace drift::cli
