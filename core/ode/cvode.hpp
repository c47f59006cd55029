#pragma once

#include <memory>
#include <span>

#include "core/ode/function_ref.hpp"
#include "core/ode/ode_options.hpp"
#include "core/ode/ode_result.hpp"

namespace drift {

/// Variable-step, variable-order integrator of y' = f(t, y): SUNDIALS' CVODE(S) behind a narrow
/// door.
///
/// Made once per thread and used for many runs; `start` makes it forget everything that came
/// before, also after a failure, so that a run gives the same bits wherever it is executed. Nothing
/// is allocated between the constructor and the first failure. Not to be shared between threads.
///
///   Cvode ode(Cvode::Method::adams, 3, options);
///   ode.system(rhs);
///   for (segment) {
///     ode.start(t0, y0, t_stop);
///     for (t : nodes) if (auto r = ode.advance(t); !r.ok()) return r;
///     use ode.state();
///   }
///
/// A discontinuity of f belongs at a segment boundary: f is never called beyond t_stop.
/// Source: Hindmarsh et al., ACM TOMS 31(3), 2005; physics.md 6.2 to 6.4.
class Cvode {
 public:
  enum class Method {
    adams,  ///< Adams-Moulton, orders 1 to 12, fixed-point corrector: smooth, not stiff
    bdf,    ///< backward differences, orders 1 to 5, Newton with a dense Jacobian: stiff
  };

  /// n states, the same absolute tolerance for each.
  Cvode(Method method, int n, const OdeOptions& options);
  /// Absolute tolerance per state, shape n; options.abs_tol is not used.
  Cvode(Method method, const OdeOptions& options, std::span<const double> abs_tol);
  ~Cvode();
  Cvode(Cvode&&) noexcept;
  Cvode& operator=(Cvode&&) noexcept;

  /// What to integrate; method bdf needs the Jacobian. The callables are not copied: they must live
  /// as long as they are integrated (temporaries do not compile).
  void system(OdeRhs rhs, OdeJacobian jacobian = {});

  /// Begins at (t0, y0) with a fresh budget of steps and wall time; t_stop >= t0. Inside, time
  /// counts from t0, so that short first steps survive at large t. first_step [s]: 0 lets CVODE
  /// choose.
  void start(double t0, const double* y0, double t_stop, double first_step = 0.0);

  /// The longest step from the next start on [s], beside that of the options; 0: none beside it.
  void limit_steps(double longest);

  /// Brings the state to min(t_out, t_stop); t_out must not decrease from call to call. The result
  /// between steps is interpolated to the accuracy of the tolerances. After a failure the state is
  /// the last accepted one, and every further call repeats the failure until the next start.
  OdeResult advance(double t_out);

  /// y at the time of the last result, shape n.
  std::span<const double> state() const;
  OdeStats stats() const;
  int size() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace drift
