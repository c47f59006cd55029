#pragma once

namespace drift {

/// How tightly the integrator follows the equations, and when it gives up.
///
/// The two limits make every run end: a run that reaches one is a failed run, not a hung study.
struct OdeOptions {
  double rel_tol = 1e-10;    ///< relative tolerance of one step [-]
  double abs_tol = 1e-12;    ///< absolute tolerance of one step [unit of the state]
  double max_step = 0.0;     ///< longest step [s]; 0: as long as the tolerances allow
  long max_steps = 2000000;  ///< steps from one `start` on, then `too_many_steps`
  double wall_limit = 0.0;   ///< wall time from one `start` on [s], then `wall_time`; 0: none
};

}  // namespace drift
