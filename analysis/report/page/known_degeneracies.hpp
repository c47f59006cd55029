#pragma once

#include <string>
#include <vector>

#include "core/estimate/layout.hpp"
#include "core/physics/triads.hpp"

namespace drift::report {

/// A combination of parameters that some tests cannot see, by physics.md 2.4.
struct KnownDegeneracy {
  VecX direction;  ///< over the prior-scaled parameters, layout order
  std::string reason;
  double tolerance;  ///< length of the unit direction's part that may lie outside the space
};

/// All whose parameters are in the layout. Whether a test has them is for its information to say.
std::vector<KnownDegeneracy> known_degeneracies(const Layout& layout, const Mounting& mounting);

/// Why a parameter may leave no signal at all.
std::string no_signal_reason(std::size_t param);

}  // namespace drift::report
