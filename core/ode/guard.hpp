#pragma once

#include <chrono>
#include <exception>
#include <string>

#include "core/ode/function_ref.hpp"
#include "core/ode/ode_result.hpp"

namespace drift::detail {

/// Stands between the C solver and the C++ right-hand side: no exception passes, no derivative that
/// is not finite passes (CVODE would creep along a NaN for a hundred thousand calls), and the wall
/// clock is looked at now and then. Its calls return what CVODE expects: 0, or -1 to stop at once.
///
/// A failure is final until clear(): with the fixed-point corrector CVODES 6.4.1 answers -1 with
/// ten shorter steps, and would creep up to the obstacle again and again if one of them succeeded.
class Guard {
 public:
  /// Forgets the last failure.
  void clear() noexcept;
  /// Starts the wall clock; `limit` in seconds, 0: none.
  void start_clock(double limit) noexcept;

  int rhs(const OdeRhs& f, double t, const double* y, double* y_dot, int n) noexcept;
  int jacobian(const OdeJacobian& f, double t, const double* y, double* J, int n) noexcept;
  /// Any other right-hand side, already bound to its arguments: its `size` results are checked.
  int bound(FunctionRef<bool()> f, double t, const double* result, int size) noexcept;

  bool failed() const { return status_ != OdeStatus::ok; }
  /// The failure in words. Call only when failed().
  OdeResult failure() const;

 private:
  using Clock = std::chrono::steady_clock;
  int fail(OdeStatus status, double t) noexcept;
  bool out_of_time() noexcept;

  OdeStatus status_ = OdeStatus::ok;
  double t_ = 0.0;
  int component_ = 0;  ///< the first one that is not finite
  std::exception_ptr thrown_;

  double limit_ = 0.0;  ///< [s]
  Clock::time_point begin_{}, last_{};
  long interval_ = 1;  ///< calls between two looks at the clock
  long until_look_ = 1;
};

/// Index of the first entry that is NaN or infinite, or -1.
int first_nonfinite(const double* x, int n) noexcept;

}  // namespace drift::detail
