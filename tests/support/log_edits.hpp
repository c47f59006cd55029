#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace drift::test {

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// What stands before the first of two texts and after it.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A CSV file with the cells of a column as they are after `change`.
template <class Change>
std::string with_column(const std::string& text, const std::string& name, Change&& change) {
  std::istringstream lines(text);
  std::string out, line;
  std::ptrdiff_t column = -1;
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (column >= 0 && !line.starts_with('#'))
      cells[static_cast<std::size_t>(column)] = change(cells[static_cast<std::size_t>(column)]);
    if (const auto it = std::ranges::find(cells, name); it != cells.end())
      column = it - cells.begin();
    for (std::size_t i = 0; i < cells.size(); ++i) out += (i > 0 ? "," : "") + cells[i];
    out += "\n";
  }
  return out;
}

}  // namespace drift::test
