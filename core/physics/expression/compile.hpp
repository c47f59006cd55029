#pragma once

#include "core/physics/expression/tree.hpp"

namespace drift {

/// Puts an equation in postfix order; operations on constants are done at once. A mistake if it
/// does not fit into a Program.
OrMistake<EquationProgram> compile_tree(const EquationTree& tree);

}  // namespace drift
