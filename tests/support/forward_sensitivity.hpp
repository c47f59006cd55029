#pragma once

#include <span>

#include "core/base/linalg.hpp"
#include "core/ode/function_ref.hpp"
#include "core/ode/ode_options.hpp"
#include "core/ode/ode_result.hpp"

namespace drift {

/// All sensitivities at once: S_dot = J(t, y) S + df/dp, with S, S_dot column-major n x n_p.
using SensitivityRhs = FunctionRef<bool(double t, const double* y, const double* y_dot,
                                        const double* S, double* S_dot)>;

/// y and S = dy/dp at one time.
struct SensitivityResult {
  OdeResult result;  ///< y and S are of result.t
  VecX y;            ///< shape n
  MatX S;            ///< shape n x n_p
  OdeStats stats;    ///< rhs_calls are those of y
};

/// Integrates y' = f(t, y) with its sensitivities from (t0, y0, S0) to t1 by CVODES' staggered
/// forward method (Adams, fixed point); the sensitivities are part of the error test. An
/// independent oracle for tests and benches: correct and slow, it allocates all it needs at each
/// call.
///
/// p_scale: size of each parameter, shape n_p, > 0; S_j is held to abs_tol / p_scale_j.
/// options.wall_limit and max_steps apply; a failure is a value.
/// Source: Hindmarsh et al., ACM TOMS 31(3), 2005; physics.md 6.5 (i).
SensitivityResult integrate_with_sensitivities(OdeRhs rhs, SensitivityRhs sensitivity_rhs,
                                               const OdeOptions& options, double t0, const VecX& y0,
                                               const MatX& S0, std::span<const double> p_scale,
                                               double t1);

}  // namespace drift
