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

}  // namespace drift
