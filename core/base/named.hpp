#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace drift {

/// A value of an enum and what it is called in files. The table of an enum is an array of these, or
/// of rows that say more of each value and have a `name` and a `value` too.
template <class E>
struct Named {
  std::string_view name;
  E value;
};

/// The name of a value in its table; empty if the table has none.
template <class Row, std::size_t N, class E>
constexpr std::string_view name_in(const Row (&table)[N], E value) {
  for (const Row& row : table)
    if (row.value == value) return row.name;
  return {};
}

/// The value that a table has under this name.
template <class Row, std::size_t N>
constexpr auto value_in(const Row (&table)[N], std::string_view name)
    -> std::optional<decltype(Row::value)> {
  for (const Row& row : table)
    if (row.name == name) return row.value;
  return std::nullopt;
}

}  // namespace drift
