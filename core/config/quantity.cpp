#include "core/config/quantity.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

#include "core/config/declared_key.hpp"
#include "core/config/nearest.hpp"

namespace drift::config {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string shown(std::string_view symbol) {
  return symbol == "1" ? "" : fmt::format(" {}", symbol);
}

/// A number that has the user's digits: 45.750 is shown as 45.75.
std::string number(double value) {
  return fmt::format("{:.12g}", value);
}

/// The first factor of a compound unit that is none, and what it may have meant.
std::string unit_suggestion(std::string_view text, const Unit& wanted) {
  std::vector<std::string_view> known;
  for (const auto& base : detail::base_units)
    if (base.symbol != "1") known.push_back(base.symbol);
  if (nearest(text, std::vector<std::string_view>{wanted.symbol.view()}).size() == 1)
    return fmt::format("Did you mean '{}'?", wanted.symbol.view());
  for (std::size_t start = 0; start <= text.size();) {
    const auto end = std::min(text.find_first_of("*/^", start), text.size());
    const auto factor = text.substr(start, end - start);
    if (!parse_unit(factor) && !(factor.size() == 1 && factor[0] >= '1' && factor[0] <= '9'))
      if (const auto close = nearest(factor, known); !close.empty())
        return fmt::format("Did you mean '{}'?", fmt::join(close, "' or '"));
    start = end + 1;
  }
  return fmt::format("Write the value in '{}'", wanted.symbol.view());
}

/// A unit of study files; beside those of physics the short times of counters and stamps.
std::optional<Unit> unit_of(std::string_view symbol) {
  for (const auto& [text, size] : {std::pair{"us", 1e-6}, std::pair{"ns", 1e-9}})
    if (symbol == text) return Unit{Name(text), size, unit::s.dim};
  return parse_unit(symbol);
}

/// A number, what is wrong with it, and the text behind it.
struct NumberAndSymbol {
  double value = 0.0;
  std::errc error{};
  std::string_view symbol;
};
NumberAndSymbol split(std::string_view whole) {
  std::string_view text = trimmed(whole);
  if (text.starts_with('+')) text.remove_prefix(1);
  NumberAndSymbol out;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out.value);
  out.error = error;
  out.symbol = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  return out;
}

/// Why a temperature cannot be taken that is on a scale with another zero: "2 K" may be meant as
/// what is 2 degC more, or as what is near absolute zero.
std::string other_zero(const Quantity& q, const Unit& wanted) {
  const double level = (q.si() + celsius_offset(q.unit) - celsius_offset(wanted)) / wanted.to_si;
  return fmt::format(
      "is in {}, which has another zero (expected {}). Write \"{}\" if it is a temperature, \"{}\" "
      "if it is a difference of two",
      q.unit.symbol.view(), expected_quantity(wanted), quantity_text(level, wanted),
      quantity_text(q.in(wanted), wanted));
}

/// Splits and converts "60 min"; empty, with the reason in `why`, if it is none.
std::optional<Quantity> parse(std::string_view whole, const Option& option, std::string& why) {
  const Unit& wanted = option.unit;
  const bool dimensionless = wanted.same_dimension(unit::one);
  const auto [value, error, symbol] = split(whole);
  Quantity q{value, unit::one};
  if (error == std::errc::invalid_argument) {
    why = fmt::format("has no number (expected {}). Write a number and a unit",
                      expected_quantity(wanted));
    return std::nullopt;
  }
  if (error != std::errc() || !std::isfinite(q.value)) {
    why = fmt::format("is not a finite number (expected {}). Correct the number",
                      expected_quantity(wanted));
    return std::nullopt;
  }
  if (symbol.empty()) {
    if (dimensionless) return q;
    why = fmt::format("has no unit (expected {}). Write \"{} {}\", or the unit that is meant",
                      expected_quantity(wanted), number(q.value), wanted.symbol.view());
    return std::nullopt;
  }
  const auto unit = unit_of(symbol);
  if (!unit && symbol.front() == ',') {
    why = fmt::format("has a decimal comma (expected {}). Write a decimal point",
                      expected_quantity(wanted));
    return std::nullopt;
  }
  if (!unit) {
    why = fmt::format("has the unknown unit '{}' (expected {}). {}", symbol,
                      expected_quantity(wanted), unit_suggestion(symbol, wanted));
    return std::nullopt;
  }
  if (!unit->same_dimension(wanted)) {
    why = dimensionless
              ? fmt::format("has the unit '{}' (expected {}). Remove the unit", symbol,
                            expected_quantity(wanted))
              : fmt::format(
                    "has the unit '{}', which measures something else (expected {}). Write "
                    "the value in '{}'",
                    symbol, expected_quantity(wanted), wanted.symbol.view());
    return std::nullopt;
  }
  q.unit = *unit;
  if (!option.difference && celsius_offset(*unit) != celsius_offset(wanted)) {
    why = other_zero(q, wanted);
    return std::nullopt;
  }
  return q;
}

}  // namespace

std::string expected_quantity(const Unit& unit) {
  if (unit.same_dimension(unit::one))
    return unit.symbol.view() == "1"
               ? "a number without unit"
               : fmt::format("a number without unit, or such as \"1 {}\"", unit.symbol.view());
  return fmt::format("a number with a unit, such as \"1 {}\"", unit.symbol.view());
}

std::string range_text(const Option& option) {
  constexpr double none = std::numeric_limits<double>::max();
  const std::string unit = shown(option.unit.symbol);
  if (option.min == -none) return fmt::format("at most {}{}", number(option.max), unit);
  if (option.max == none) return fmt::format("at least {}{}", number(option.min), unit);
  return fmt::format("{}{} to {}{}", number(option.min), unit, number(option.max), unit);
}

std::string quantity_text(double value, const Unit& unit) {
  return number(value) + shown(unit.symbol);
}

std::optional<Quantity> quantity_in(std::string_view text) {
  const auto [value, error, symbol] = split(text);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  const std::optional<Unit> unit = symbol.empty() ? unit::one : unit_of(symbol);
  if (!unit) return std::nullopt;
  return Quantity{value, *unit};
}

std::optional<Quantity> read_quantity(Report& report, const Node& node, std::string_view key,
                                      const Option& option) {
  report.declare_at(key, declared_number("", "", option));
  const bool is_number = node.is(Node::Kind::integer) || node.is(Node::Kind::real);
  const double plain = node.is(Node::Kind::integer) ? static_cast<double>(node.integer) : node.real;
  std::optional<Quantity> q;
  std::string why;
  if (node.is(Node::Kind::string)) {
    q = parse(node.text, option, why);
    if (!q) why = fmt::format("'{}' = {} {}", key, to_toml(node), why);
  } else if (is_number && !std::isfinite(plain)) {
    why = fmt::format("'{}' = {} is not a finite number (expected {}). Correct the number", key,
                      to_toml(node), expected_quantity(option.unit));
  } else if (is_number && option.unit.same_dimension(unit::one)) {
    q = Quantity{plain, unit::one};
  } else if (is_number) {
    why = fmt::format(
        "'{}' = {} has no unit (expected {}). Write {} = \"{} {}\", or the unit that is "
        "meant",
        key, to_toml(node), expected_quantity(option.unit), option.key.empty() ? key : option.key,
        to_toml(node), option.unit.symbol.view());
  } else {
    why = fmt::format("'{}' is {} (expected {}). Write a single value", key, describe(node),
                      expected_quantity(option.unit));
  }
  if (q) {
    const double value = q->in(option.unit);
    constexpr double room = 1e-12;  // for the rounding of a conversion
    if (!(value >= option.min - room * std::abs(option.min) &&
          value <= option.max + room * std::abs(option.max))) {
      why = fmt::format("'{}' = {} is out of range (expected {}). Check value and unit", key,
                        to_toml(node), range_text(option));
      q.reset();
    }
  }
  if (!q) report.error(node.at, why);
  return q;
}

}  // namespace drift::config
