#pragma once

#include <string>
#include <vector>

#include "core/estimate/layout.hpp"
#include "core/physics/triads.hpp"
#include "core/plan/excitation.hpp"

namespace drift::report {

/// A combination of parameters that some tests cannot see: a parameter alone, or by physics.md 2.4.
struct KnownDegeneracy {
  VecX direction;         ///< over the prior-scaled parameters, layout order
  std::string reason;     ///< empty of a parameter alone: no_signal_reason()
  double tolerance;       ///< length of the unit direction's part that may lie outside the space
  bool anywhere = false;  ///< whether no position of a laboratory shows it
};

/// All whose parameters are in the layout, those alone first. Whether a test has them is for its
/// information to say.
std::vector<KnownDegeneracy> known_degeneracies(const Layout& layout, const Mounting& mounting);

/// Why a parameter leaves hardly a signal or, exactly, none: what the test does not do that it
/// takes, where that is so.
std::string no_signal_reason(std::size_t param, bool exact, const Mounting& mounting,
                             const Excitation& excitation);

}  // namespace drift::report
