#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace drift {

/// A string that can be a template argument: per_gyro<"D_I">.
template <std::size_t N>
struct FixedString {
  std::array<char, N> text{};
  // NOLINTNEXTLINE(google-explicit-constructor): a literal is meant to convert
  constexpr FixedString(const char (&s)[N]) { std::copy_n(s, N, text.begin()); }
  constexpr std::string_view view() const { return {text.data(), N - 1}; }
};

/// A short name stored in place, so that tables of names can be constexpr.
struct Name {
  static constexpr std::size_t capacity = 31;
  std::array<char, capacity + 1> text{};
  std::size_t size = 0;

  constexpr Name() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a name is a string
  constexpr Name(std::string_view s) { append(s); }
  constexpr void append(std::string_view s) {
    if (size + s.size() > capacity) throw "name too long";  // a compile error in constexpr use
    for (char c : s) text[size++] = c;
  }
  constexpr std::string_view view() const { return {text.data(), size}; }
  constexpr operator std::string_view() const { return view(); }  // NOLINT
  constexpr bool operator==(const Name& other) const { return view() == other.view(); }
};

}  // namespace drift
