#pragma once

#include "core/ode/handles.hpp"

namespace drift::detail {

/// Direct solver of A x = b for dense n x n: LU with partial pivoting, compiled with this program
/// (Debian's is built without optimisation). No allocation after it is made.
LinearSolverPtr make_dense_solver(int n, _SUNContext* context);

}  // namespace drift::detail
