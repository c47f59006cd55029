#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/base/words.hpp"
#include "core/physics/coupling.hpp"

namespace drift {

/// The couplings that are wanted, as a study file has them: "eq5", "eq6" or "lambda", each in
/// quotation marks. wanted(coupling): whether one is.
template <class Wanted>
std::string names_of_couplings(Wanted&& wanted) {
  std::vector<std::string> names;
  for (const CouplingFacts& c : couplings)
    if (wanted(c.value)) names.push_back(fmt::format("\"{}\"", c.name));
  return listed(names, "or");
}

/// All of them.
inline std::string names_of_couplings() {
  return names_of_couplings([](Coupling) { return true; });
}

/// Those that are an equation of their own whatever the truth is: what a filter may be tried with.
inline std::string names_of_equations() {
  return names_of_couplings(
      [](Coupling c) { return is_algebraic(c) && facts(c).compensating_nothing == c; });
}

}  // namespace drift
