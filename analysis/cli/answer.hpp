#pragma once

#include <string>
#include <vector>

#include "analysis/report/page/report.hpp"

namespace drift::cli {

/// What there is beside an answer in brief.
struct Rest {
  std::string details;             ///< what --full prints behind it
  std::string folder;              ///< where files were written; empty: nowhere
  std::vector<std::string> files;  ///< their names
  std::string document = {};       ///< what --json prints instead of all that
};

/// What a command found, by the rule of all commands: the answer in at most ten lines, with --full
/// whole, in colour where the terminal shows one; where the report is; and, with --full, the rest.
void show_answer(const report::InBrief& brief, const Rest& rest);

/// Words that go with it: to standard output, or to standard error where that is for JSON alone.
void show_beside_answer(const std::string& text);

}  // namespace drift::cli
