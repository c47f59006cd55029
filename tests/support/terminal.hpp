#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/support/program.hpp"

namespace drift::test {

/// Whether script(1) is here, which gives a command a terminal.
inline bool has_terminal() {
  return std::system("script --version >/dev/null 2>&1") == 0;
}

/// What a command shows where its output is a terminal. folder: for the record of it.
inline std::string shown_on_a_terminal(const ScratchFolder& folder, const std::string& command) {
  const std::string typed = folder.file("typed");
  const std::string line = "script -qec '" + command + "' " + typed + " >/dev/null 2>&1 </dev/null";
  EXPECT_EQ(std::system(line.c_str()), 0) << line;
  return text_of(typed);
}

}  // namespace drift::test
