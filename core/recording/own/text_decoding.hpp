#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace drift {

/// Bytes of Windows-1252, which ISO 8859-1 is part of, as UTF-8.
std::string utf8_from_windows_1252(std::string_view bytes);

/// Turns UTF-16 into UTF-8, piece by piece; what is no character becomes U+FFFD.
class Utf16Decoder {
 public:
  enum class Order { little, big };
  explicit Utf16Decoder(Order order) : order_(order) {}

  /// The text of the next bytes; half a character at their end waits for the rest.
  std::string decode(std::string_view bytes);

 private:
  Order order_;
  std::optional<unsigned char> half_;
  std::uint32_t high_ = 0;  ///< first half of a surrogate pair; 0: none
};

}  // namespace drift
