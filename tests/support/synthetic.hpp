#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/support/program.hpp"

namespace drift::test {

/// The program with made-up runs (synthetic_program.cpp).
inline Answer synthetic(const std::string& arguments) {
  return run_program(DRIFT_SYNTHETIC, arguments);
}

/// 200 runs of one point, in blocks of 64, 64, 64 and 8.
inline std::string study_file(const ScratchFolder& scratch) {
  return scratch.write(
      "study.toml",
      "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = \"six\"\n[truth]\n"
      "coupling = \"eq5\"\n[[filter]]\nname = \"eq5\"\ncoupling = \"eq5\"\n"
      "[monte_carlo]\nruns = 200\nseed = 7\nallowed_failures = 99\n");
}

inline void expect_says(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nin: " << text;
}

}  // namespace drift::test
