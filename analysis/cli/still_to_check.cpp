#include "analysis/cli/still_to_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/base/file_text.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift::cli {
namespace {

/// Whether the key that a line begins with has its value from the command line.
bool given_otherwise(const mc::Study& study, std::string_view line) {
  const std::string_view key = trimmed(line.substr(0, line.find('=')));
  return !key.empty() && std::ranges::any_of(study.resolved, [&](const mc::Resolved& r) {
    return r.origin == "--set" && std::string_view(r.key).ends_with(key);
  });
}

/// What stands before ": check" where a clause ends so, however it is spelt.
std::optional<std::string> to_be_checked(std::string_view clause) {
  constexpr std::string_view mark = "check";
  if (clause.size() < mark.size() || lower_case(clause.substr(clause.size() - mark.size())) != mark)
    return std::nullopt;
  const std::string_view before = trimmed(clause.substr(0, clause.size() - mark.size()));
  if (!before.ends_with(':')) return std::nullopt;
  return std::string(trimmed(before.substr(0, before.size() - 1)));
}

}  // namespace

std::vector<StillToCheck> still_to_check(const mc::Study& study) {
  constexpr std::size_t longest = 40;  // of a value that is shown: one line
  std::vector<StillToCheck> out;
  std::istringstream lines(file_text(study.path).value_or(""));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto hash = line.rfind("# ");
    if (hash == std::string::npos || given_otherwise(study, line)) continue;
    const std::string_view value = trimmed(std::string_view(line).substr(0, hash));
    std::string_view rest = std::string_view(line).substr(hash + 2);
    while (!rest.empty()) {
      const auto end = rest.find("; ");
      if (auto what = to_be_checked(trimmed(rest.substr(0, end))))
        out.push_back(
            {number, value.size() <= longest ? std::string(value) : "", std::move(*what)});
      rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 2);
    }
  }
  return out;
}

std::string still_to_check_text(const mc::Study& study) {
  const auto open = still_to_check(study);
  if (open.empty()) return {};
  std::string text = fmt::format(
      "note: {}: `new` guessed what nobody has checked yet. Where it is right, take \": check\" "
      "out "
      "of the comment:\n",
      study.path);
  for (const StillToCheck& one : open)
    text += one.value.empty() ? fmt::format("  line {}: {}\n", one.line, one.what)
                              : fmt::format("  line {}: {} ({})\n", one.line, one.value, one.what);
  return text;
}

}  // namespace drift::cli
