#pragma once

#include <array>
#include <initializer_list>
#include <string_view>

#include "core/base/fixed_string.hpp"
#include "core/base/units.hpp"
#include "core/params/prior.hpp"

namespace drift {

/// How a parameter enters, and so how it can be found.
enum class ParamKind {
  linear,     ///< an amplitude: the measurements depend on it (almost) linearly
  nonlinear,  ///< a time constant: known unless a study gives it a prior, or profiled on its grid
  moment,     ///< when something sets in, since the start of the test: as nonlinear, but profiled
              ///< over the test, whatever its length
  discrete,   ///< a number that is one of a few: never a state of a filter, profiled on its grid
  noise,      ///< the size of something random: drives the truth; a filter takes it as known
};

/// Values over which a nonlinear or discrete parameter is profiled, in the parameter's unit.
struct Grid {
  static constexpr std::size_t capacity = 12;
  std::array<double, capacity> values{};
  std::size_t size = 0;

  constexpr Grid() = default;
  constexpr Grid(std::initializer_list<double> list) {  // too many do not compile in constexpr use
    for (const double v : list) values[size++] = v;
  }
  constexpr const double* begin() const { return values.data(); }
  constexpr const double* end() const { return values.data() + size; }
};

/// All that is to be known of a physical parameter; it is declared here and nowhere else.
struct ParamSpec {
  Name key;                 ///< "D_I_z", as in files
  Name group;               ///< "D_I"
  std::string_view axis;    ///< "z", "outer"; empty if it belongs to none
  Unit unit;                ///< unit of files, tables and of `prior`
  Prior prior;              ///< default prior, in `unit`
  std::string_view enters;  ///< where it enters the equations
  ParamKind kind = ParamKind::linear;
  Grid grid = {};  ///< of a nonlinear or discrete parameter

  constexpr Prior prior_si() const { return prior.scaled(unit.to_si); }
  /// The size of an effect, which may be missing; or what an effect cannot do without: a time
  /// constant, a harmonic number. What is random is neither.
  constexpr bool amplitude() const { return kind == ParamKind::linear; }
  constexpr bool setting() const { return continuous() || kind == ParamKind::discrete; }
  /// A setting that may lie between any two values.
  constexpr bool continuous() const {
    return kind == ParamKind::nonlinear || kind == ParamKind::moment;
  }
};

namespace detail {

/// One parameter for each of three things, named group_suffix.
consteval std::array<ParamSpec, 3> three(std::string_view group,
                                         std::array<std::string_view, 3> suffixes, Unit unit,
                                         Prior prior, std::string_view enters, ParamKind kind) {
  std::array<ParamSpec, 3> specs{};
  for (std::size_t i = 0; i < 3; ++i) {
    Name key(group);
    key.append("_");
    key.append(suffixes[i]);
    specs[i] = {key, Name(group), suffixes[i], unit, prior, enters, kind, {}};
  }
  return specs;
}

}  // namespace detail

/// One parameter for each of the three instruments or platform axes x, y, z.
template <FixedString Group>
consteval std::array<ParamSpec, 3> per_axis(Unit unit, Prior prior, std::string_view enters,
                                            ParamKind kind = ParamKind::linear) {
  return detail::three(Group.view(), {"x", "y", "z"}, unit, prior, enters, kind);
}

/// One parameter for each of the three gimbals, outermost first.
template <FixedString Group>
consteval std::array<ParamSpec, 3> per_gimbal(Unit unit, Prior prior, std::string_view enters) {
  return detail::three(Group.view(), {"outer", "middle", "inner"}, unit, prior, enters,
                       ParamKind::linear);
}

/// A parameter that belongs to no axis.
template <FixedString Key>
consteval std::array<ParamSpec, 1> single(Unit unit, Prior prior, std::string_view enters,
                                          ParamKind kind = ParamKind::linear) {
  return {ParamSpec{Name(Key.view()), Name(Key.view()), {}, unit, prior, enters, kind, {}}};
}

/// A parameter that is known unless a study says otherwise, with the values to profile it over.
template <FixedString Key>
consteval std::array<ParamSpec, 1> profiled(ParamKind kind, Unit unit, double value, Grid grid,
                                            std::string_view enters) {
  return {
      ParamSpec{Name(Key.view()), Name(Key.view()), {}, unit, fixed(value), enters, kind, grid}};
}

/// When something sets in, since the start of the test; `value` where a study does not say.
template <FixedString Key>
consteval std::array<ParamSpec, 1> moment(Unit unit, double value, std::string_view enters) {
  return profiled<Key>(ParamKind::moment, unit, value, {}, enters);
}

/// Several lists of parameters, one after the other.
template <std::size_t... N>
consteval auto join(const std::array<ParamSpec, N>&... lists) {
  std::array<ParamSpec, (N + ...)> all{};
  std::size_t next = 0;
  auto add = [&](const auto& list) {
    for (const auto& spec : list) all[next++] = spec;
  };
  (add(lists), ...);
  return all;
}

}  // namespace drift
