#include "analysis/report/page/swept_value.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace drift::report {
namespace {

bool is_key(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '-';
}

/// Name and text of each member of an inline table; empty for anything else.
std::vector<std::pair<std::string, std::string>> members_of(const std::string& value) {
  std::vector<std::pair<std::string, std::string>> members;
  if (!value.starts_with('{')) return members;
  int depth = 0;
  bool quoted = false;
  std::size_t from = 1;
  const auto take = [&](std::size_t to) {
    const std::string_view text = std::string_view(value).substr(from, to - from);
    from = to + 1;
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) return;
    std::string name;
    for (const char c : text.substr(0, equals))
      if (is_key(c)) name += c;
    members.emplace_back(std::move(name), text.substr(equals + 1));
  };
  for (std::size_t k = 0; k < value.size(); ++k) {
    const char c = value[k];
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '{' || c == '[') ++depth;
    if ((c == ',' && depth == 1) || (c == '}' && depth == 1)) take(k);
    if (c == '}' || c == ']') --depth;
  }
  return members;
}

/// A value without the blanks around it, a text without its quotes.
std::string without_quotes(std::string_view member) {
  const auto is_around = [](char c) { return c == ' ' || c == '"'; };
  while (!member.empty() && is_around(member.front())) member.remove_prefix(1);
  while (!member.empty() && is_around(member.back())) member.remove_suffix(1);
  return std::string(member);
}

}  // namespace

std::optional<SweptNumber> swept_number(const std::string& value) {
  std::optional<SweptNumber> last;
  const char* const end = value.data() + value.size();
  for (const char* p = value.data(); p < end;) {
    const bool word_before = p > value.data() && (std::isalnum(static_cast<unsigned char>(p[-1])) ||
                                                  p[-1] == '_' || p[-1] == '^');
    double number = 0.0;
    const auto [after, error] = std::from_chars(p, end, number);
    if (word_before || error != std::errc() || !std::isfinite(number) ||
        std::isalpha(static_cast<unsigned char>(*p))) {
      ++p;
      continue;
    }
    const char* from = after;
    while (from < end && *from == ' ') ++from;
    const char* to = from;
    while (to < end && (std::isalnum(static_cast<unsigned char>(*to)) ||
                        std::string_view("/^*%()").find(*to) != std::string_view::npos))
      ++to;
    const auto unit = parse_unit(std::string_view(from, static_cast<std::size_t>(to - from)));
    last = SweptNumber{number * (unit ? unit->to_si : 1.0), unit.value_or(unit::one)};
    p = after;
  }
  return last;
}

std::string last_member(const std::string& value) {
  const auto members = members_of(value);
  return members.empty() ? std::string() : members.back().first;
}

std::string short_value(const std::string& value) {
  const auto members = members_of(value);
  std::string text;
  for (const auto& [name, member] : members) {
    const auto number = swept_number(member);
    text += text.empty() ? "" : ", ";
    if (number && number->unit.symbol.view() != unit::one.symbol.view())
      text += fmt::format("{} {:.6g} {}", name, number->si / number->unit.to_si,
                          number->unit.symbol.view());
    else if (number)
      text += fmt::format("{} {:.6g}", name, number->si);
    else if (members.size() == 1 && member.find('"') != std::string::npos)
      text += without_quotes(member);
    else
      text += fmt::format("{} {}", name, without_quotes(member));
  }
  return text.empty() ? value : text;
}

}  // namespace drift::report
