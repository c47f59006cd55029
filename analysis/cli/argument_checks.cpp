#include "analysis/cli/argument_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "core/config/nearest.hpp"

namespace drift::cli {

std::string check_whole(const std::string& text, std::uint64_t least, std::uint64_t most) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  if (whole && value >= least && value <= most) return {};
  return fmt::format(
      "'{}' is no such number (expected a whole number from {} to {}). Choose one in that range",
      text, least, most);
}

std::string check_seed(const std::string& text) {
  const bool hexadecimal = text.starts_with("0x");
  const char* begin = text.data() + (hexadecimal ? 2 : 0);
  const char* all = text.data() + text.size();
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(begin, all, value, hexadecimal ? 16 : 10);
  if (error == std::errc() && end == all) return {};
  return fmt::format(
      "'{}' is no seed (expected a whole number from 0 to 2^64-1, decimal or as \"0x...\"). "
      "Choose another",
      text);
}

std::string check_one_of(const std::string& text, std::span<const std::string_view> names) {
  if (std::ranges::find(names, text) != names.end()) return {};
  return fmt::format("'{}' is not known (expected one of {}). {}", text, fmt::join(names, ", "),
                     config::suggestion(text, names, "Use one of these"));
}

std::string check_path(const std::string& text) {
  return text.empty()
             ? "the name is empty (expected a file or folder). Give one, or leave the option out"
             : "";
}

std::string check_given(const std::string& text) {
  return text.empty() ? "the value is empty (expected one; a variable that is not set?). Give one, "
                        "or leave the option out"
                      : "";
}

std::string check_no_file(const std::string& text) {
  for (const char* end : {".toml", ".csv", ".h5", ".hdf5", ".mat"})
    if (text.ends_with(end) || text.find('/') != text.npos)
      return fmt::format(
          "'{}' is no term (expected terms, separated by commas, or nothing). Write the option "
          "behind the files",
          text);
  return "";
}

std::vector<std::string> list_of(const std::string& text) {
  std::vector<std::string> items;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) items.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return items;
}

std::string unknown(std::string_view what, std::string_view given,
                    std::span<const std::string_view> known) {
  return fmt::format("unknown {} '{}' (expected one of {}). {}", what, given,
                     fmt::join(known, ", "),
                     config::suggestion(given, known, "`driftscope --help` explains them"));
}

}  // namespace drift::cli
