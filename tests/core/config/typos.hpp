#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace drift::test {

/// The key to the right (or, at the end of a row, to the left) of a character on a keyboard.
inline char neighbour_key(char c) {
  static const std::string rows[] = {"qwertyuiop", "asdfghjkl", "zxcvbnm", "1234567890-"};
  const bool upper = std::isupper(static_cast<unsigned char>(c)) != 0;
  const char low = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& row : rows)
    if (const auto at = row.find(low); at != std::string::npos) {
      const char next = at + 1 < row.size() ? row[at + 1] : row[at - 1];
      return upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(next))) : next;
    }
  return '-';  // of the underscore
}

/// Every single slip in a word: a letter dropped, two swapped, one doubled, one replaced by its
/// neighbour on the keyboard, one in the wrong case.
inline std::vector<std::string> typos(const std::string& word) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < word.size(); ++i) {
    std::string typo = word;
    typo.erase(i, 1);
    all.push_back(typo);
    typo = word;
    typo.insert(i, 1, word[i]);
    all.push_back(typo);
    typo = word;
    typo[i] = neighbour_key(word[i]);
    all.push_back(typo);
    const auto letter = static_cast<unsigned char>(word[i]);
    typo = word;
    typo[i] = static_cast<char>(std::isupper(letter) ? std::tolower(letter) : std::toupper(letter));
    all.push_back(typo);
    if (i + 1 == word.size()) continue;
    typo = word;
    std::swap(typo[i], typo[i + 1]);
    all.push_back(typo);
  }
  std::erase_if(all, [&](const std::string& typo) { return typo == word || typo.empty(); });
  return all;
}

/// Edit distance with insertion, deletion, substitution and swap of neighbours, each of cost 1:
/// the textbook recursion, with memory.
inline int edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1, -1));
  const auto distance = [&](auto&& self, std::size_t i, std::size_t j) -> int {
    if (i == 0) return static_cast<int>(j);
    if (j == 0) return static_cast<int>(i);
    if (d[i][j] >= 0) return d[i][j];
    int best = std::min(self(self, i - 1, j), self(self, i, j - 1)) + 1;
    best = std::min(best, self(self, i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1));
    if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
      best = std::min(best, self(self, i - 2, j - 2) + 1);
    return d[i][j] = best;
  };
  return distance(distance, a.size(), b.size());
}

}  // namespace drift::test
