#include "core/config/declared_key.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/config/quantity.hpp"

namespace drift::config {
namespace {

using Kind = DeclaredKey::Kind;

Option without_key(Option option) {
  option.key = {};  // it may be a text that is gone when the record is read
  return option;
}

}  // namespace

DeclaredKey declared_number(std::string section, std::string key, const Option& option) {
  const Kind kind = option.unit.same_dimension(unit::one) ? Kind::number : Kind::quantity;
  return {std::move(section), std::move(key), kind, expected_quantity(option.unit),
          without_key(option)};
}

DeclaredKey declared_whole(std::string section, std::string key, const Option& option) {
  return {std::move(section), std::move(key), Kind::whole, expected_whole(option),
          without_key(option)};
}

DeclaredKey declared_choice(std::string section, std::string key, std::vector<std::string> names) {
  std::string expected = expected_choice(names);
  return {std::move(section), std::move(key), Kind::choice, std::move(expected), {},
          std::move(names)};
}

std::string expected_text() {
  return fmt::format("a text of one line, at most {} bytes", longest_text);
}

std::string expected_whole(const Option& option) {
  return unbounded_whole(option)
             ? std::string("a whole number from 0 to 2^64-1, beyond 2^63-1 as \"0x...\"")
             : fmt::format("a whole number from {:.0f} to {:.0f}", option.min, option.max);
}

std::string expected_choice(const std::vector<std::string>& names) {
  return fmt::format("one of \"{}\"", fmt::join(names, "\", \""));
}

std::string expected_section(const std::string& path) {
  return fmt::format("a section [{}] or a table", path);
}

std::string expected_sections(const std::string& path) {
  return fmt::format("a list of sections, each headed [[{}]]", path);
}

}  // namespace drift::config
