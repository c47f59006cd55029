#include "mc/store/text_difference.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drift::mc {
namespace {

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace

std::vector<std::string> difference(std::string_view a, std::string_view b, std::size_t most) {
  std::vector<std::string_view> x = lines_of(a), y = lines_of(b);
  // Longest common subsequence of what is left between the equal begin and the equal end.
  while (!x.empty() && !y.empty() && x.back() == y.back()) x.pop_back(), y.pop_back();
  std::size_t same = 0;
  while (same < std::min(x.size(), y.size()) && x[same] == y[same]) ++same;
  x.erase(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(same));
  y.erase(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(same));
  constexpr std::size_t longest = 2000;  // the table below stays within some megabytes
  x.resize(std::min(x.size(), longest));
  y.resize(std::min(y.size(), longest));
  const std::size_t m = x.size(), n = y.size();
  std::vector<std::uint16_t> common((m + 1) * (n + 1), 0);
  const auto at = [&](std::size_t i, std::size_t j) -> std::uint16_t& {
    return common[i * (n + 1) + j];
  };
  for (std::size_t i = m; i-- > 0;)
    for (std::size_t j = n; j-- > 0;)
      at(i, j) = x[i] == y[j] ? static_cast<std::uint16_t>(at(i + 1, j + 1) + 1)
                              : std::max(at(i + 1, j), at(i, j + 1));
  std::vector<std::string> out;
  for (std::size_t i = 0, j = 0; i < m || j < n;) {
    if (i < m && j < n && x[i] == y[j]) {
      ++i, ++j;
    } else if (i < m && (j == n || at(i + 1, j) >= at(i, j + 1))) {
      out.push_back(fmt::format("- {}", x[i++]));
    } else {
      out.push_back(fmt::format("+ {}", y[j++]));
    }
  }
  if (out.size() > most) {
    const std::size_t more = out.size() - most;
    out.resize(most);
    out.push_back(fmt::format("... and {} more", more));
  }
  return out;
}

}  // namespace drift::mc
