#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "mc/study/study.hpp"

namespace drift::cli {

/// What every command that reads a study file takes.
struct StudyArguments {
  std::string config;
  std::vector<std::string> sets;  ///< "key=value"
  std::optional<std::string> seed;
  std::string progress = "auto";  ///< auto, plain, json, none

  /// Reads the study with the overrides of the command line, and notes those without effect.
  mc::Study read() const;
  mc::Overrides overrides() const;
};

/// A list with one more at its end.
inline std::vector<std::string> with(std::vector<std::string> list, const std::string& more) {
  list.push_back(more);
  return list;
}

}  // namespace drift::cli
