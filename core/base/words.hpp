#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

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

}  // namespace drift
