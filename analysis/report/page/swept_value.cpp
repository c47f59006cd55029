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

/// A text without what `is_around` says at both ends.
template <class Around>
std::string stripped(std::string_view text, Around is_around) {
  while (!text.empty() && is_around(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_around(text.back())) text.remove_suffix(1);
  return std::string(text);
}

/// A value without the blanks around it, a text without its quotes.
std::string without_quotes(std::string_view member) {
  return stripped(member, [](char c) { return c == ' ' || c == '"'; });
}

/// The texts between the outermost brackets of a table or list, which commas part, in order.
std::vector<std::string> list_parts(std::string_view value) {
  std::vector<std::string> parts;
  int depth = 0;
  bool quoted = false;
  std::size_t from = 1;
  for (std::size_t k = 0; k < value.size(); ++k) {
    const char c = value[k];
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '{' || c == '[') ++depth;
    if (depth == 1 && (c == ',' || c == '}' || c == ']')) {
      parts.push_back(
          stripped(value.substr(from, k - from), [](char blank) { return blank == ' '; }));
      from = k + 1;
    }
    if (c == '}' || c == ']') --depth;
  }
  return parts;
}

using Members = std::vector<std::pair<std::string, std::string>>;

/// Name and text of each member of an inline table; empty for anything else.
Members members_of(const std::string& value) {
  Members members;
  if (!value.starts_with('{')) return members;
  for (const std::string& part : list_parts(value)) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) continue;
    std::string name;
    for (const char c : part.substr(0, equals))
      if (is_key(c)) name += c;
    members.emplace_back(std::move(name), stripped(std::string_view(part).substr(equals + 1),
                                                   [](char blank) { return blank == ' '; }));
  }
  return members;
}

/// `{ normal = ["0 deg/h", "5 deg/h"] }`.
struct SweptDistribution {
  bool is_normal = false;
  std::string first, second;  ///< without quotes
};
std::optional<SweptDistribution> distribution_in(const Members& members) {
  if (members.size() != 1) return std::nullopt;
  const auto& [name, list] = members.front();
  if ((name != "normal" && name != "uniform") || !list.starts_with('[')) return std::nullopt;
  const std::vector<std::string> ends = list_parts(list);
  if (ends.size() != 2) return std::nullopt;
  return SweptDistribution{name == "normal", without_quotes(ends[0]), without_quotes(ends[1])};
}

/// "-40 +- 5 deg/h" of a normal distribution, "-90 to 5 deg/h" of a uniform one; of two units both.
std::string distribution_text(const SweptDistribution& d) {
  const std::size_t one = d.first.find(' '), other = d.second.find(' ');
  const bool one_unit = one != std::string::npos && other != std::string::npos &&
                        d.first.substr(one) == d.second.substr(other);
  return fmt::format("{} {} {}", one_unit ? d.first.substr(0, one) : d.first,
                     d.is_normal ? "+-" : "to", d.second);
}

/// The last number in a text, in SI, with its unit; `before`, where the text before it goes.
std::optional<SweptNumber> last_number(const std::string& value, std::string& before) {
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
    last = SweptNumber{number * (unit ? unit->to_si : 1.0), unit.value_or(unit::one), {}, {}};
    before.assign(value.data(), p);
    p = after;
  }
  return last;
}

/// Of a normal distribution its sigma, of a uniform one its half width or upper end: what else it
/// is must not differ where such numbers are compared.
std::optional<SweptNumber> distribution_number(const SweptDistribution& d) {
  std::string before;
  const auto first = last_number(d.first, before);
  auto number = last_number(d.second, before);
  if (!first || !number) return std::nullopt;
  const bool about_zero = !d.is_normal && first->si == -number->si;
  number->what = d.is_normal ? "sigma" : about_zero ? "half width" : "upper end";
  number->kind = about_zero ? number->what : fmt::format("{} of {:.12g}", number->what, first->si);
  return number;
}

std::string short_member(const std::string& member);

/// "eta 5 arcsec, xi 5 arcsec".
std::string short_members(const Members& members) {
  if (const auto d = distribution_in(members)) return distribution_text(*d);
  std::string text;
  for (const auto& [name, member] : members) {
    text += text.empty() ? "" : ", ";
    const bool speaks_for_itself =
        members.size() == 1 && member.starts_with('"') && !swept_number(member);
    text += speaks_for_itself ? without_quotes(member)
                              : fmt::format("{} {}", name, short_member(member));
  }
  return text;
}

/// Of a table in a table, or a list, all that it holds.
std::string short_member(const std::string& member) {
  const Members members = members_of(member);
  if (members.empty()) return without_quotes(member);
  return distribution_in(members) ? short_members(members)
                                  : fmt::format("({})", short_members(members));
}

}  // namespace

std::optional<SweptNumber> swept_number(const std::string& value) {
  const Members members = members_of(value);
  if (const auto d = distribution_in(members)) return distribution_number(*d);
  if (members.empty()) {
    std::string before;
    auto number = last_number(value, before);
    if (number) number->kind = without_quotes(before);
    return number;
  }
  auto number = swept_number(members.back().second);
  if (!number) return std::nullopt;
  std::string names;
  for (const auto& [name, member] : members) {
    const auto one = swept_number(member);
    names += fmt::format("{} {} ", name, one ? one->what : "");
  }
  number->kind = names + number->kind;
  return number;
}

std::string last_member(const std::string& value) {
  const Members members = members_of(value);
  return members.empty() || distribution_in(members) ? std::string() : members.back().first;
}

std::string short_value(const std::string& value) {
  const std::string text = short_members(members_of(value));
  return text.empty() ? value : text;
}

}  // namespace drift::report
