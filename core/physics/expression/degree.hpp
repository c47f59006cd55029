#pragma once

#include <optional>
#include <vector>

#include "core/physics/expression/tree.hpp"

namespace drift {

/// Whether an equation is proportional to its amplitudes together, as an estimator takes it to be:
/// amplitudes stand in every summand once, in no denominator, no power and no function. By the form
/// of the equation, so what would cancel counts. Nothing if it is, or if there is no amplitude.
/// amplitude: of each parameter.
std::optional<EquationMistake> mistake_of_degree(const EquationTree& tree,
                                                 const std::vector<bool>& amplitude,
                                                 const std::vector<std::string>& names);

}  // namespace drift
