#include "core/recording/recording_problems.hpp"

#include <fmt/format.h>

#include "core/base/check.hpp"

namespace drift {

void Problems::add(std::string_view where, std::string_view wrong, std::string_view expected,
                   std::string_view fix) {
  if (full()) {
    ++more_;
    return;
  }
  messages_.push_back(fmt::format("{}:{}{} {} (expected {}). {}", file_, where,
                                  where.empty() ? "" : ":", wrong, expected, fix));
}

void Problems::add(std::string message) {
  if (full())
    ++more_;
  else
    messages_.push_back(std::move(message));
}

void Problems::throw_if_any() const {
  if (count() == 0) return;
  auto all = messages_;
  if (more_ > 0)
    all.push_back(
        fmt::format("{}: and {} more problems. Correct the ones above first", file_, more_));
  throw InputError(ExitCode::recording, std::move(all));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  const bool keep_high = valid_utf8(text);
  std::size_t size = std::min(text.size(), longest);
  // A shortened UTF-8 text ends between two characters.
  while (keep_high && size < text.size() && (text[size] & 0xC0) == 0x80) --size;
  std::string out = "'";
  for (const char c : text.substr(0, size)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || (byte >= 0x80 && !keep_high))
      out += fmt::format("\\x{:02x}", byte);
    else
      out += c;
  }
  return out + (size < text.size() ? "...'" : "'");
}

bool valid_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80       ? 1
                               : lead >> 5 == 6  ? 2
                               : lead >> 4 == 14 ? 3
                               : lead >> 3 == 30 ? 4
                                                 : 0;
    if (length == 0 || i + length > text.size()) return false;
    char32_t code = length == 1 ? lead : lead & (0xFFu >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if (next >> 6 != 2) return false;
      code = code << 6 | (next & 0x3Fu);
    }
    constexpr char32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    if (code < smallest[length] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000))
      return false;
    i += length;
  }
  return true;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

}  // namespace drift
