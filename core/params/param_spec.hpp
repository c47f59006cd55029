#pragma once

#include <array>
#include <string_view>

#include "core/base/fixed_string.hpp"
#include "core/base/units.hpp"
#include "core/params/prior.hpp"

namespace drift {

/// All that is to be known of a physical parameter; it is declared here and nowhere else.
struct ParamSpec {
  Name key;                 ///< "D_I_z", as in files
  Name group;               ///< "D_I"
  Unit unit;                ///< unit of files, tables and of `prior`
  Prior prior;              ///< default prior, in `unit`
  std::string_view enters;  ///< where it enters the equations

  constexpr Prior prior_si() const { return prior.scaled(unit.to_si); }
};

/// One parameter for each of the three instruments x, y, z.
template <FixedString Group>
consteval std::array<ParamSpec, 3> per_axis(Unit unit, Prior prior, std::string_view enters) {
  std::array<ParamSpec, 3> specs{};
  for (int i = 0; i < 3; ++i) {
    Name key(Group.view());
    key.append("_");
    key.append(std::string_view("xyz").substr(i, 1));
    specs[i] = {key, Name(Group.view()), unit, prior, enters};
  }
  return specs;
}

/// A parameter that belongs to no axis.
template <FixedString Key>
consteval std::array<ParamSpec, 1> single(Unit unit, Prior prior, std::string_view enters) {
  return {ParamSpec{Name(Key.view()), Name(Key.view()), unit, prior, enters}};
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
