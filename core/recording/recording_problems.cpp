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
    all.push_back(fmt::format(
        "{}: and {} more problems (expected none). Correct the ones above first", file_, more_));
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

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

}  // namespace drift
