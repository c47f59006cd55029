#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>

namespace drift {

/// FNV-1a hash of a text, of 32 or 64 bits.
template <std::unsigned_integral U>
constexpr U fnv1a(std::string_view text) {
  static_assert(sizeof(U) == 4 || sizeof(U) == 8);
  constexpr bool wide = sizeof(U) == 8;
  U h = wide ? static_cast<U>(14695981039346656037u) : 2166136261u;
  for (const char c : text)
    h = (h ^ static_cast<unsigned char>(c)) * (wide ? static_cast<U>(1099511628211u) : 16777619u);
  return h;
}

}  // namespace drift
