#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/physics/expression/tree.hpp"

namespace drift {

/// The names an equation may use: inputs and parameters, each by its place in the list.
struct EquationNames {
  std::span<const std::string> inputs;
  std::span<const std::string> parameters;
};

/// Names of the functions and constants of the language, which nothing else may have.
std::vector<std::string_view> reserved_equation_names();

/// Reads an equation: numbers, pi, names, + - * / ^ (which binds from the right and before a minus
/// sign: -x^2 is -(x^2)), parentheses and the functions
///   sin cos tan exp log sqrt abs tanh atan step sign min max pow
OrMistake<EquationTree> parse_equation(std::string_view text, const EquationNames& names);

}  // namespace drift
