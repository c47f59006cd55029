#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>

#include "core/base/fixed_string.hpp"

namespace drift {

/// Exponents of the base dimensions, doubled so that deg/sqrt(h) has whole numbers.
/// Angle is a dimension of its own (a misalignment in metres is an error), and so is g: specific
/// force is kept in units of local g throughout.
struct Dimension {
  enum Base { angle, time, g, length, temperature, field, mass, current, count };
  std::array<std::int8_t, count> twice{};
  constexpr bool operator==(const Dimension&) const = default;
};

/// A unit of measure: how it is written, its size in the internal unit, its dimension.
/// Internal units: rad, s, g (local), m, K (temperature differences), T, kg, A.
struct Unit {
  Name symbol;
  double to_si = 1.0;
  Dimension dim;
  constexpr bool same_dimension(const Unit& other) const { return dim == other.dim; }
};

namespace detail {

struct BaseUnit {
  std::string_view symbol;
  double to_si;
  Dimension dim;
};

constexpr Dimension dim_of(Dimension::Base base, int exponent = 1) {
  Dimension d;
  d.twice[base] = static_cast<std::int8_t>(2 * exponent);
  return d;
}

inline constexpr double deg = std::numbers::pi / 180.0;       // [rad]
inline constexpr double earth_rate = 7.292115e-5;             // [rad/s]
inline constexpr Dimension newton{{0, -4, 0, 2, 0, 0, 2}};    // kg m/s^2
inline constexpr Dimension pascal{{0, -4, 0, -2, 0, 0, 2}};   // N/m^2
inline constexpr Dimension volt{{0, -6, 0, 4, 0, 0, 2, -2}};  // N m/s/A
inline constexpr BaseUnit base_units[] = {
    {"1", 1.0, {}},
    {"ppm", 1e-6, {}},
    {"%", 1e-2, {}},
    {"rad", 1.0, dim_of(Dimension::angle)},
    {"mrad", 1e-3, dim_of(Dimension::angle)},
    {"urad", 1e-6, dim_of(Dimension::angle)},
    {"deg", deg, dim_of(Dimension::angle)},
    {"arcmin", deg / 60.0, dim_of(Dimension::angle)},
    {"arcsec", deg / 3600.0, dim_of(Dimension::angle)},
    {"turn", 360.0 * deg, dim_of(Dimension::angle)},
    {"s", 1.0, dim_of(Dimension::time)},
    {"ms", 1e-3, dim_of(Dimension::time)},
    {"min", 60.0, dim_of(Dimension::time)},
    {"h", 3600.0, dim_of(Dimension::time)},
    {"day", 86400.0, dim_of(Dimension::time)},
    {"Hz", 1.0, dim_of(Dimension::time, -1)},
    {"meru", 1e-3 * earth_rate, {{2, -2, 0, 0, 0, 0, 0}}},
    {"g", 1.0, dim_of(Dimension::g)},
    {"mg", 1e-3, dim_of(Dimension::g)},
    {"ug", 1e-6, dim_of(Dimension::g)},
    {"m", 1.0, dim_of(Dimension::length)},
    {"cm", 1e-2, dim_of(Dimension::length)},
    {"mm", 1e-3, dim_of(Dimension::length)},
    {"degC", 1.0, dim_of(Dimension::temperature)},
    {"K", 1.0, dim_of(Dimension::temperature)},
    {"T", 1.0, dim_of(Dimension::field)},
    {"mT", 1e-3, dim_of(Dimension::field)},
    {"uT", 1e-6, dim_of(Dimension::field)},
    {"gauss", 1e-4, dim_of(Dimension::field)},
    {"kg", 1.0, dim_of(Dimension::mass)},
    {"N", 1.0, newton},
    {"Pa", 1.0, pascal},
    {"hPa", 1e2, pascal},
    {"kPa", 1e3, pascal},
    {"A", 1.0, dim_of(Dimension::current)},
    {"mA", 1e-3, dim_of(Dimension::current)},
    {"V", 1.0, volt},
    {"mV", 1e-3, volt},
};

constexpr double int_power(double x, int n) {
  double r = 1.0;
  for (int i = 0; i < (n < 0 ? -n : n); ++i) r *= x;
  return n < 0 ? 1.0 / r : r;
}

constexpr double square_root(double x) {  // constexpr, for "sqrt(h)"
  double r = x > 1.0 ? x : 1.0;
  for (int i = 0; i < 200; ++i) r = 0.5 * (r + x / r);
  return r;
}

}  // namespace detail

/// Reads "deg/h/g^2", "deg/sqrt(h)", "N*m/rad", "ug": factors joined by * and /, with whole powers.
/// Empty if the text is not a unit this program knows.
constexpr std::optional<Unit> parse_unit(std::string_view text) {
  if (text.empty() || text.size() > Name::capacity) return std::nullopt;
  Unit unit{Name(text), 1.0, {}};
  std::string_view rest = text;
  int sign = 1;
  while (true) {
    const auto end = rest.find_first_of("*/");
    std::string_view factor = rest.substr(0, end);
    bool root = false;
    if (factor.starts_with("sqrt(") && factor.ends_with(")")) {
      root = true;
      factor = factor.substr(5, factor.size() - 6);
    }
    int power = 1;
    if (const auto caret = factor.find('^'); caret != std::string_view::npos) {
      if (caret + 2 != factor.size() || factor[caret + 1] < '1' || factor[caret + 1] > '9')
        return std::nullopt;
      power = factor[caret + 1] - '0';
      factor = factor.substr(0, caret);
    }
    const std::size_t known = std::size(detail::base_units);
    std::size_t which = 0;
    while (which < known && detail::base_units[which].symbol != factor) ++which;
    if (which == known) return std::nullopt;
    const detail::BaseUnit& base = detail::base_units[which];
    const double size = root ? detail::square_root(base.to_si) : base.to_si;
    unit.to_si *= detail::int_power(size, sign * power);
    for (int d = 0; d < Dimension::count; ++d)
      unit.dim.twice[d] = static_cast<std::int8_t>(
          unit.dim.twice[d] + sign * power * base.dim.twice[d] / (root ? 2 : 1));
    if (end == std::string_view::npos) return unit;
    sign = rest[end] == '/' ? -1 : 1;
    rest = rest.substr(end + 1);
  }
}

/// A unit known when the program is compiled; a symbol that is none does not compile.
template <FixedString text>
constexpr Unit operator""_unit() {
  constexpr std::optional<Unit> unit = parse_unit(text.view());
  static_assert(unit.has_value(), "not a unit this program knows");
  return *unit;
}

/// What is to be added to a temperature in this unit, after its size, to have it in degC [K]; of a
/// unit that measures something else nothing.
constexpr double celsius_offset(const Unit& unit) {
  if (unit.dim != detail::dim_of(Dimension::temperature)) return 0.0;
  const std::string_view symbol = unit.symbol.view();
  if (symbol.ends_with('K') || symbol.ends_with("Kelvin")) return -273.15;
  return symbol.ends_with('F') || symbol.ends_with("Fahrenheit") ? -32.0 / 1.8 : 0.0;
}

namespace unit {
inline constexpr Unit one = "1"_unit;
inline constexpr Unit ppm = "ppm"_unit;
inline constexpr Unit rad = "rad"_unit;
inline constexpr Unit deg = "deg"_unit;
inline constexpr Unit arcsec = "arcsec"_unit;
inline constexpr Unit s = "s"_unit;
inline constexpr Unit minute = "min"_unit;
inline constexpr Unit hour = "h"_unit;
inline constexpr Unit deg_per_h = "deg/h"_unit;
inline constexpr Unit deg_per_s = "deg/s"_unit;
inline constexpr Unit deg_per_h_per_g = "deg/h/g"_unit;
inline constexpr Unit deg_per_h_per_g2 = "deg/h/g^2"_unit;
inline constexpr Unit deg_per_sqrt_h = "deg/sqrt(h)"_unit;
inline constexpr Unit deg_per_h_per_sqrt_h = "deg/h/sqrt(h)"_unit;
inline constexpr Unit g = "g"_unit;
inline constexpr Unit ug = "ug"_unit;
inline constexpr Unit ug_per_g2 = "ug/g^2"_unit;
inline constexpr Unit ug_per_g3 = "ug/g^3"_unit;
}  // namespace unit

}  // namespace drift
