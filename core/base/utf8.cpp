#include "core/base/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drift {
namespace {

unsigned byte_of(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

char32_t code_of(std::string_view character) {
  const unsigned lead = byte_of(character, 0);
  char32_t code = character.size() == 1 ? lead : lead & (0xFFu >> (character.size() + 1));
  for (std::size_t k = 1; k < character.size(); ++k)
    code = code << 6 | (byte_of(character, k) & 0x3Fu);
  return code;
}

/// Controls of C0 and C1 but line ends and tabs; marks that change the direction of writing.
bool steers(char32_t code) {
  if (code == '\n' || code == '\t') return false;
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x061C ||
         (code >= 0x200E && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

enum class Steering { kept, shown };

std::string shown(std::string_view bytes, Steering steering) {
  std::string out;
  out.reserve(bytes.size());
  while (!bytes.empty()) {
    const std::size_t size = utf8_character(bytes);
    const std::string_view character = bytes.substr(0, std::max<std::size_t>(size, 1));
    bytes.remove_prefix(character.size());
    const char32_t code = size == 0 ? 0 : code_of(character);
    if (size == 0)
      out += fmt::format("\\x{:02x}", byte_of(character, 0));
    else if (steering == Steering::shown && steers(code))
      out += code < 0x80 ? fmt::format("\\x{:02x}", static_cast<unsigned>(code))
                         : fmt::format("\\u{:04x}", static_cast<unsigned>(code));
    else
      out += character;
  }
  return out;
}

}  // namespace

std::size_t utf8_character(std::string_view text) {
  if (text.empty()) return 0;
  const unsigned lead = byte_of(text, 0);
  const std::size_t size = lead < 0x80       ? 1
                           : lead >> 5 == 6  ? 2
                           : lead >> 4 == 14 ? 3
                           : lead >> 3 == 30 ? 4
                                             : 0;
  if (size == 0 || size > text.size()) return 0;
  for (std::size_t k = 1; k < size; ++k)
    if (byte_of(text, k) >> 6 != 2) return 0;
  const char32_t code = code_of(text.substr(0, size));
  constexpr char32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code < smallest[size] || code > 0x10FFFF || surrogate ? 0 : size;
}

bool valid_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = utf8_character(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

std::string utf8_text(std::string_view bytes) {
  return shown(bytes, Steering::kept);
}

std::string terminal_text(std::string_view bytes) {
  return shown(bytes, Steering::shown);
}

std::string text_of_name(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte == 0x7F ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return out;
}

std::string shortened_lines(std::string_view text, std::size_t longest) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (line.size() <= longest) {
      out += line;
    } else {
      std::size_t kept_before = longest * 2 / 3, kept_behind = line.size() - longest / 3;
      while (kept_before > 0 && (byte_of(line, kept_before) >> 6) == 2)
        --kept_before;  // between two characters
      while (kept_behind < line.size() && (byte_of(line, kept_behind) >> 6) == 2) ++kept_behind;
      out += fmt::format("{} ... ({} more bytes) ... {}", line.substr(0, kept_before),
                         kept_behind - kept_before, line.substr(kept_behind));
    }
    if (end < text.size()) out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

}  // namespace drift
