#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/support/program.hpp"

namespace drift::test {

/// The program with made-up runs (synthetic_program.cpp).
inline Answer synthetic(const std::string& arguments) {
  return run_program(DRIFT_SYNTHETIC, arguments);
}

inline void expect_says(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nin: " << text;
}

}  // namespace drift::test
