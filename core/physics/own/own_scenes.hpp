#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/params/param_spec.hpp"
#include "core/physics/expression/tree.hpp"

namespace drift {

/// Evaluates a program where a platform may be: at rest along its axes and in any attitude, when a
/// test begins and a day later, with every value of the grids. A mistake if it is not a number
/// there, or has no finite slope in something it names (an estimator takes slopes). inputs: names,
/// as read_input() numbers them.
std::optional<EquationMistake> mistake_in_scenes(const EquationProgram& program,
                                                 const std::vector<ParamSpec>& params,
                                                 const std::vector<std::string>& inputs);

/// Whether an equation has a slope in a parameter of own_terms(), by how it is written: in one that
/// stands inside `step` or `sign` alone it has none, and no fit is led to it. True of all others.
bool has_slope(std::size_t param);

}  // namespace drift
