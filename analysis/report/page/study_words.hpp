#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

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

/// A key of a filter, as --set takes it: by the filter's name, or where that would have to be
/// quoted by its number, from 0.
inline std::string key_of_filter(const FilterSpec& filter, std::size_t number,
                                 std::string_view key) {
  const bool plain = shell_word(filter.name) == filter.name &&
                     filter.name.find_first_of(".=") == std::string::npos;
  return fmt::format("filter.{}.{}", plain ? filter.name : fmt::format("{}", number), key);
}

}  // namespace drift::report
