#include "core/recording/own/text_decoding.hpp"

namespace drift {
namespace {

void append_utf8(std::string& out, std::uint32_t c) {
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0 | c >> 6);
    out += static_cast<char>(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    out += static_cast<char>(0xE0 | c >> 12);
    out += static_cast<char>(0x80 | (c >> 6 & 0x3F));
    out += static_cast<char>(0x80 | (c & 0x3F));
  } else {
    out += static_cast<char>(0xF0 | c >> 18);
    out += static_cast<char>(0x80 | (c >> 12 & 0x3F));
    out += static_cast<char>(0x80 | (c >> 6 & 0x3F));
    out += static_cast<char>(0x80 | (c & 0x3F));
  }
}

constexpr std::uint32_t no_character = 0xFFFD;

}  // namespace

std::string utf8_from_windows_1252(std::string_view bytes) {
  // 0x80 to 0x9F; five of them are no character and stand for themselves.
  constexpr std::uint16_t typographic[32] = {
      0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
      0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
      0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    append_utf8(out, byte >= 0x80 && byte < 0xA0 ? typographic[byte - 0x80] : byte);
  }
  return out;
}

std::string Utf16Decoder::decode(std::string_view bytes) {
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (!half_) {
      half_ = byte;
      continue;
    }
    const std::uint32_t first = *half_, second = byte;
    half_.reset();
    const std::uint32_t unit = order_ == Order::little ? first | second << 8 : first << 8 | second;
    const bool low = unit >= 0xDC00 && unit < 0xE000;
    if (high_ != 0)
      append_utf8(out, low ? 0x10000 + (high_ - 0xD800) * 0x400 + (unit - 0xDC00) : no_character);
    const bool paired = high_ != 0 && low;
    high_ = unit >= 0xD800 && unit < 0xDC00 ? unit : 0;
    if (!paired && high_ == 0) append_utf8(out, low ? no_character : unit);
  }
  return out;
}

}  // namespace drift
