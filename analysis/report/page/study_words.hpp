#pragma once

#include <string>

#include "core/base/words.hpp"
#include "mc/study/study.hpp"

namespace drift::report {

/// A study as words of a command to be copied into a shell, with what the command line set in it:
/// "lab.toml --set 'site.latitude=48.1 deg'"; "STUDY" where it stands in no file.
inline std::string study_words(const mc::Study& study) {
  if (study.path.empty()) return "STUDY";
  std::string words = shell_word(study.path);
  for (const auto& [key, value] : study.overrides)
    words += " --set " + shell_word(key + "=" + value);
  return words;
}

}  // namespace drift::report
