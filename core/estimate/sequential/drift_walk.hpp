#pragma once

#include <vector>

#include "core/estimate/layout.hpp"

namespace drift {

/// The states of a filter whose value is not constant: D_F where something random acts through it.
std::vector<std::size_t> walking_states(const FilterSpec& filter, const Layout& layout);

/// Variance that such a state gains over a time [s], in units of its prior's.
double walk_variance(const FilterSpec& filter, const Layout& layout, std::size_t state,
                     const Theta& theta, double duration);
/// The same from the beginning of a recording to that of another one.
double variance_between_recordings(const FilterSpec& filter, const Layout& layout,
                                   std::size_t state, const Theta& theta);

}  // namespace drift
