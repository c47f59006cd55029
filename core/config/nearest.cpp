#include "core/config/nearest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace drift::config {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Are two keys next to each other on a QWERTY keyboard?
bool neighbours(char a, char b) {
  static constexpr std::array<std::string_view, 4> rows = {"1234567890-", "qwertyuiop", "asdfghjkl",
                                                           "zxcvbnm"};
  const auto find = [](char c) -> std::pair<int, int> {
    for (int row = 0; row < static_cast<int>(rows.size()); ++row)
      if (const auto column = rows[row].find(c); column != std::string_view::npos)
        return {row, static_cast<int>(column)};
    return {-10, -10};
  };
  const auto [row_a, column_a] = find(a);
  const auto [row_b, column_b] = find(b);
  if (row_a < 0 || row_b < 0) return false;
  if (row_a == row_b) return std::abs(column_a - column_b) == 1;
  if (std::abs(row_a - row_b) != 1) return false;
  const int shift = row_a > row_b ? column_b - column_a : column_a - column_b;
  return shift == 0 || shift == 1;  // a lower row sits half a key to the right
}

double substitution(char a, char b) {
  if (a == b) return 0.0;
  if (lower(a) == lower(b)) return 0.25;
  return neighbours(lower(a), lower(b)) ? 0.9 : 1.0;
}

/// A name without the number that it ends with.
std::string_view without_number(std::string_view name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  if (last + 1 == name.size()) return name;
  name = name.substr(0, last + 1);
  if (name.ends_with('_')) name.remove_suffix(1);
  return name;
}

/// Whether one word was slipped into another: once, or twice in a long one.
bool word_slipped(std::string_view typed, std::string_view meant) {
  constexpr std::size_t a_letter_tells = 3, long_word = 6;  // letters
  const double cost = typing_distance(typed, meant);
  if (typed.size() < a_letter_tells) return cost < 0.9;  // by capitals, or a doubled letter
  return cost <= (typed.size() < long_word ? 1.0 : 2.0);
}

std::vector<std::string_view> words_of(std::string_view name) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('_', begin), name.size());
    words.push_back(name.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

}  // namespace

double typing_distance(std::string_view typed, std::string_view meant) {
  const std::size_t n = typed.size(), m = meant.size();
  std::vector<double> before(m + 1), last(m + 1), row(m + 1);
  for (std::size_t j = 0; j <= m; ++j) last[j] = static_cast<double>(j);
  for (std::size_t i = 1; i <= n; ++i) {
    row[0] = static_cast<double>(i);
    for (std::size_t j = 1; j <= m; ++j) {
      const char a = typed[i - 1], b = meant[j - 1];
      const double doubled = i > 1 && a == typed[i - 2] ? 0.8 : 1.0;
      row[j] = std::min({last[j] + doubled, row[j - 1] + 1.0, last[j - 1] + substitution(a, b)});
      if (i > 1 && j > 1 && a == meant[j - 2] && typed[i - 2] == b)
        row[j] = std::min(row[j], before[j - 2] + 1.0);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[m];
}

std::vector<std::string_view> nearest(std::string_view typed,
                                      std::span<const std::string_view> keys) {
  constexpr std::size_t longest = 128;  // nobody means a key by more
  constexpr std::size_t most = 3;
  if (typed.size() > longest) return {};
  const double enough = std::max(1.5, 0.4 * static_cast<double>(typed.size()));
  std::vector<std::pair<double, std::string_view>> found;
  for (const auto key : keys)
    if (const double cost = typing_distance(typed, key); cost <= enough)
      found.emplace_back(cost, key);
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string_view> best;
  for (const auto& [cost, key] : found)
    if (best.size() < most && cost < found.front().first + 1e-9) best.push_back(key);
  return best;
}

bool is_slip(std::string_view typed, std::string_view meant) {
  if (without_number(typed) == without_number(meant)) return false;
  const double cost = typing_distance(typed, meant);
  if (cost <= 1.0) return word_slipped(typed, meant);
  if (cost > 2.0) return false;
  const auto a = words_of(typed), b = words_of(meant);
  return std::ranges::equal(a, b, word_slipped);
}

std::string suggestion(std::string_view typed, std::span<const std::string_view> keys,
                       std::string_view otherwise) {
  const auto close = nearest(typed, keys);
  if (close.empty()) return std::string(otherwise);
  return fmt::format("Did you mean '{}'?", fmt::join(close, "' or '"));
}

}  // namespace drift::config
