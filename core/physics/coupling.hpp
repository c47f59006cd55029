#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>

#include "core/base/named.hpp"

namespace drift {

/// How the platform servo answers the gyros. None of these is "the right one": it depends on the
/// hardware (physics.md 1.6).
enum class Coupling {
  eq5,          ///< w_cp = -C w_ic - u (Fu, Shao, Deng 2002)
  eq6,          ///< w_cp = -w_ic - C^-1 u (Hellings 1973)
  lambda,       ///< the family that holds both
  compensated,  ///< gyros on the case, the loop removes an estimate C-hat
  servo,        ///< the null-seeking loop itself, integrated (servo.hpp)
};

/// The coupling that another is alike under some condition; itself where there is no such. It has
/// no default: a row of the table that does not say it does not compile.
struct Alike {
  constexpr Alike(Coupling alike) : coupling(alike) {}
  constexpr operator Coupling() const { return coupling; }
  Coupling coupling;
};

/// What is to be known of a coupling beside its formula (closed_over).
struct CouplingFacts {
  Coupling value;
  std::string_view name;          ///< "eq5", as in files
  int number;                     ///< of the equation; 0: it is neither of the two
  std::string_view equation;      ///< the drift equation, on one line
  std::optional<double> lambda;   ///< which member of the family it is; none: it is none by name
  std::optional<Coupling> other;  ///< the other equation, where there are two
  Alike settles_to;               ///< once nothing of its own moves any more
  Alike compensating_nothing;     ///< while its loop believes in no misalignment (E_loop = 0)
};

inline constexpr CouplingFacts couplings[] = {
    {Coupling::eq5, "eq5", 5, "w_cp = -C w_ic - w_l - w_md", 0.0, Coupling::eq6, Coupling::eq5,
     Coupling::eq5},
    {Coupling::eq6, "eq6", 6, "w_cp = -w_ic - C^-1 (w_l + w_md)", 1.0, Coupling::eq5, Coupling::eq6,
     Coupling::eq6},
    {Coupling::lambda,
     "lambda",
     0,
     "w_cp = -(I + lambda E)^-1 (C w_ic + w_l + w_md)",
     {},
     {},
     Coupling::lambda,
     Coupling::lambda},
    {Coupling::compensated,
     "compensated",
     0,
     "w_cp = -(I + E_loop)^-1 (C w_ic + w_l + w_md)",
     {},
     {},
     Coupling::compensated,
     Coupling::eq5},
    {Coupling::servo,
     "servo",
     0,
     "null-seeking loop, integrated",
     {},
     {},
     Coupling::eq6,
     Coupling::servo}};

constexpr const CouplingFacts& facts(Coupling coupling) {
  return couplings[static_cast<std::size_t>(coupling)];
}
static_assert(
    [] {
      for (std::size_t k = 0; k < std::size(couplings); ++k)
        if (facts(static_cast<Coupling>(k)).value != static_cast<Coupling>(k)) return false;
      return true;
    }(),
    "the rows stand in the order of the enum");

constexpr std::string_view key_of(Coupling coupling) {
  return facts(coupling).name;
}
constexpr std::string_view equation_of(Coupling coupling) {
  return facts(coupling).equation;
}

/// Whether it has no states of its own: a filter can have it as its equation.
constexpr bool is_algebraic(Coupling coupling) {
  return facts(coupling).settles_to == coupling;
}

/// The equations that a filter can have, as files call them.
inline constexpr Named<Coupling> couplings_of_filters[] = {
    {key_of(Coupling::eq5), Coupling::eq5},
    {key_of(Coupling::eq6), Coupling::eq6},
    {key_of(Coupling::lambda), Coupling::lambda},
    {key_of(Coupling::compensated), Coupling::compensated}};
static_assert(
    [] {
      for (const CouplingFacts& c : couplings)
        if (is_algebraic(c.value) == name_in(couplings_of_filters, c.value).empty()) return false;
      return true;
    }(),
    "they are the algebraic ones");

/// With lambda as a parameter: a member of the family by name becomes the same by number.
constexpr Coupling family_of(Coupling coupling) {
  return facts(coupling).lambda ? Coupling::lambda : coupling;
}

}  // namespace drift
