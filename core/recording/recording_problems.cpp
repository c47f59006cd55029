#include "core/recording/recording_problems.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check.hpp"

namespace drift {

namespace {

/// The column of "line:column", where the line is a number.
std::string_view column_of(std::string_view where) {
  const auto digits = where.find_first_not_of("0123456789");
  return digits == std::string_view::npos ? std::string_view() : where.substr(digits);
}

bool starts_with_line(std::string_view where) {
  return !where.empty() && where.front() >= '0' && where.front() <= '9';
}

}  // namespace

bool Problems::counted(std::string_view kind, std::string_view line) {
  const auto known = std::ranges::find(messages_, kind, &Message::kind);
  if (known == messages_.end()) return false;
  ++known->alike;
  known->last_where = line;
  return true;
}

void Problems::add_in_line(std::size_t line, std::string_view sentences) {
  const std::string kind = fmt::format("\n\n\n{}", sentences);
  if (counted(kind, std::to_string(line))) return;
  if (full())
    ++more_;
  else
    messages_.push_back(
        {kind, fmt::format("{}:{}", file_, line), fmt::format(": {}", sentences), 0, {}, 0});
}

void Problems::add(std::string_view where, std::string_view wrong, std::string_view expected,
                   std::string_view fix) {
  const bool row = starts_with_line(where);
  std::string kind;  // rows of a column that lack the same, columns with the same mistake
  if (row) kind = fmt::format("{}\n{}\n{}", column_of(where), expected, fix);
  if (!row && !where.empty()) kind = fmt::format("{}\n{}\n{}", wrong, expected, fix);
  if (row && counted(kind, where.substr(0, where.find(':')))) return;
  const auto known =
      row || kind.empty() ? messages_.end() : std::ranges::find(messages_, kind, &Message::kind);
  if (known != messages_.end()) {
    known->where += fmt::format(", {}", where);
    ++known->columns;
    return;
  }
  if (full()) {
    ++more_;
    return;
  }
  messages_.push_back(
      {kind,
       fmt::format("{}:{}", file_, where),
       fmt::format("{} {} (expected {}). {}", where.empty() ? "" : ":", wrong, expected, fix),
       0,
       {},
       0});
}

void Problems::add(std::string message) {
  if (full())
    ++more_;
  else
    messages_.push_back({"", "", std::move(message), 0, {}, 0});
}

std::size_t Problems::count() const {
  std::size_t all = messages_.size() + more_;
  for (const Message& m : messages_) all += m.alike + m.columns;
  return all;
}

std::vector<std::string> Problems::messages() const {
  std::vector<std::string> texts;
  for (const Message& m : messages_)
    texts.push_back(m.where + m.text +
                    (m.alike == 0 ? ""
                                  : fmt::format(" ({} more of the kind, the last in line {})",
                                                m.alike, m.last_where)));
  return texts;
}

void Problems::throw_if_any() const {
  if (!any()) return;
  auto all = messages();
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
