#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace drift {

/// "a", "a and b", "a, b and c", with the last word between the last two.
inline std::string listed(const std::vector<std::string>& items, std::string_view last) {
  if (items.size() < 2) return items.empty() ? "" : items.front();
  return fmt::format("{} {} {}", fmt::join(items.begin(), items.end() - 1, ", "), last,
                     items.back());
}

/// "a, b, c and 4 more": the first `most`.
inline std::string listed_up_to(const std::vector<std::string>& items, std::size_t most) {
  if (items.size() <= most) return fmt::format("{}", fmt::join(items, ", "));
  return fmt::format(
      "{} and {} more",
      fmt::join(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(most), ", "),
      items.size() - most);
}

/// "position 3", "positions 1 to 6", "positions 2, 5 to 7", of ascending numbers.
inline std::string positions_text(const std::vector<int>& numbers) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t end = k + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    if (end - k > 2)
      parts.push_back(fmt::format("{} to {}", numbers[k], numbers[end - 1]));
    else
      for (std::size_t i = k; i < end; ++i) parts.push_back(std::to_string(numbers[i]));
    k = end;
  }
  return fmt::format("position{} {}", numbers.size() > 1 ? "s" : "", fmt::join(parts, ", "));
}

/// A text between single quotes of a shell.
inline std::string in_shell_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// A name as one word of a command to be copied into a shell: as it is, or in quotes where it holds
/// what a shell does not take as it is.
inline std::string shell_word(std::string_view name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           static_cast<unsigned char>(c) >= 0x80 ||
           std::string_view("_@%+=:,./-").find(c) != std::string_view::npos;
  };
  return !name.empty() && std::ranges::all_of(name, is_plain) ? std::string(name)
                                                              : in_shell_quotes(name);
}

/// The same of each, a blank between them.
inline std::string shell_words(const std::vector<std::string>& names) {
  std::vector<std::string> words;
  for (const std::string& name : names) words.push_back(shell_word(name));
  return fmt::format("{}", fmt::join(words, " "));
}

/// A text as a field of CSV by RFC 4180, which reads back as it is. One with # is quoted too: many
/// readers take what follows for a comment.
inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"#\n\r") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// A number as a field of CSV, with the shortest digits that read back as it; of one that is not
/// finite nothing.
inline std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

}  // namespace drift
