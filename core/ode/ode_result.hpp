#pragma once

#include <string>
#include <string_view>

namespace drift {

/// How an integration ended. Everything but `ok` is a failed run: a value, never an exception.
enum class OdeStatus {
  ok,
  rhs_failed,           ///< the right-hand side said "not computable"
  rhs_nonfinite,        ///< the initial state or a derivative is NaN or infinite
  rhs_threw,            ///< the right-hand side or the Jacobian threw
  jacobian_failed,      ///< the Jacobian is not computable or not finite
  too_many_steps,       ///< OdeOptions::max_steps
  wall_time,            ///< OdeOptions::wall_limit
  step_too_small,       ///< error test or corrector fail however short the step
  tolerance_too_tight,  ///< asked for more than double precision holds
  solver_failed,        ///< anything else; the cause has the solver's words
  sample_nonfinite,     ///< it ended well, and what is read off its path is NaN or infinite
};

constexpr std::string_view name(OdeStatus status) {
  switch (status) {
    case OdeStatus::ok:
      return "ok";
    case OdeStatus::rhs_failed:
      return "rhs_failed";
    case OdeStatus::rhs_nonfinite:
      return "rhs_nonfinite";
    case OdeStatus::rhs_threw:
      return "rhs_threw";
    case OdeStatus::jacobian_failed:
      return "jacobian_failed";
    case OdeStatus::too_many_steps:
      return "too_many_steps";
    case OdeStatus::wall_time:
      return "wall_time";
    case OdeStatus::step_too_small:
      return "step_too_small";
    case OdeStatus::tolerance_too_tight:
      return "tolerance_too_tight";
    case OdeStatus::solver_failed:
      return "solver_failed";
    case OdeStatus::sample_nonfinite:
      return "sample_nonfinite";
  }
  return "unknown";
}

/// Where an integration stands.
struct OdeResult {
  OdeStatus status = OdeStatus::ok;
  double t = 0.0;     ///< time of the state; after a failure, the time it is about [s]
  std::string cause;  ///< in words; empty when ok

  bool ok() const { return status == OdeStatus::ok; }
};

/// What an integration cost, from the last `start` on.
struct OdeStats {
  long steps = 0;
  long rhs_calls = 0;
  long jacobian_calls = 0;
  long error_test_failures = 0;
};

}  // namespace drift
