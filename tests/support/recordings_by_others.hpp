#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace drift::test {

/// A recording by others, which is no part of the repository.
inline std::string path_of(const std::string& recording) {
  return DRIFT_SOURCE_DIR "/../shared/recordings/" + recording;
}

}  // namespace drift::test

/// Skips a test whose recording is not there.
#define NEEDS_RECORDING(name)                               \
  if (!std::filesystem::exists(drift::test::path_of(name))) \
  GTEST_SKIP() << "recordings by others are not in ../shared/recordings"
