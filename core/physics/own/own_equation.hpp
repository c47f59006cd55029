#pragma once

#include <string>
#include <vector>

#include "core/physics/expression/tree.hpp"
#include "core/physics/own/own_term.hpp"

namespace drift {

/// The equation of a term with the parameters it may name.
struct OwnEquation {
  std::string text;
  OwnTarget target;
  std::vector<std::string> names;  ///< of the parameters
  std::vector<ParamSpec> params;
};

/// What an equation was compiled to.
struct CompiledEquation {
  EquationProgram program;
  Needs needs;
  std::vector<std::string> covariates;  ///< those that were given, and after them those it adds
};

/// Reads and compiles an equation, and checks that it names every parameter, is proportional to its
/// amplitudes, measures what it acts on, has no temperature in K beside a column in degC, and is a
/// number with a slope wherever the platform may be.
/// A name that is none and not nearly one is a column of the recording: it is looked up in
/// `covariates`.
OrMistake<CompiledEquation> compile_equation(const OwnEquation& equation,
                                             const std::vector<std::string>& covariates);

}  // namespace drift
