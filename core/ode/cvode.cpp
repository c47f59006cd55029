#include "core/ode/cvode.hpp"

#include <cvodes/cvodes.h>
#include <cvodes/cvodes_ls.h>
#include <nvector/nvector_serial.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "core/base/check.hpp"
#include "core/ode/dense.hpp"
#include "core/ode/guard.hpp"
#include "core/ode/vector_ops.hpp"

namespace drift {

using detail::check_setup;

struct Cvode::Impl {
  Impl(Method method, int size, const OdeOptions& options, std::vector<double> abs_tol);

  void begin(double t0, const double* y0, double t_stop, double first_step);
  OdeResult advance(double t_out);
  OdeResult fail(int flag);
  OdeResult fail(OdeStatus status, std::string cause);
  double time(double tau) const {
    return std::min(t0 + tau, t_stop);
  }  // rounding must not pass t_stop
  long steps() const;
  OdeStats current() const;

  static int rhs_call(double tau, N_Vector y, N_Vector y_dot, void* self) noexcept;
  static int matrix_call(double tau, N_Vector y, N_Vector fy, SUNMatrix A, booleantype reuse,
                         booleantype* computed, double gamma, void* self, N_Vector, N_Vector,
                         N_Vector) noexcept;
  static int weights_call(N_Vector y, N_Vector weights, void* self) noexcept;
  static void message_call(int, const char*, const char*, char* message, void* self) noexcept;

  Method method;
  int n;
  OdeOptions options;
  std::vector<double> abs_tol;
  OdeRhs rhs;
  OdeJacobian jacobian;

  // Destroyed from the last to the first: the context outlives all that was made in it.
  detail::ContextPtr context;
  detail::VectorPtr y;
  detail::MatrixPtr matrix;
  detail::LinearSolverPtr linear;
  detail::NonlinearSolverPtr fixed_point;
  detail::IntegratorPtr cvode;
  std::vector<double> J;  ///< column-major, as of the last evaluation

  detail::Guard guard;
  OdeResult failure;
  char message[256] =
      "";  ///< CVODE's last words; a buffer, because warnings come on good paths too
  double t0 = 0.0, t_stop = 0.0, t = 0.0;
  double longest = 0.0;  ///< step [s]; 0: as long as the tolerances allow
  bool at_stop = true;
  long jacobian_calls = 0;
};

Cvode::Impl::Impl(Method method_, int size, const OdeOptions& options_, std::vector<double> tol)
    : method(method_), n(size), options(options_), abs_tol(std::move(tol)) {
  context = detail::make_context();
  y = detail::make_vector(n, context.get());
  cvode.reset(check_setup(CVodeCreate(method == Method::adams ? CV_ADAMS : CV_BDF, context.get()),
                          "CVodeCreate"));
  check_setup(CVodeSetErrHandlerFn(cvode.get(), message_call, this), "CVodeSetErrHandlerFn");
  check_setup(CVodeInit(cvode.get(), rhs_call, 0.0, y.get()), "CVodeInit");
  check_setup(CVodeSetUserData(cvode.get(), this), "CVodeSetUserData");
  check_setup(CVodeWFtolerances(cvode.get(), weights_call), "CVodeWFtolerances");
  longest = options.max_step;
  check_setup(CVodeSetMaxHnilWarns(cvode.get(), -1), "CVodeSetMaxHnilWarns");
  if (method == Method::adams) {
    fixed_point.reset(
        check_setup(SUNNonlinSol_FixedPoint(y.get(), 0, context.get()), "SUNNonlinSol_FixedPoint"));
    check_setup(CVodeSetNonlinearSolver(cvode.get(), fixed_point.get()), "CVodeSetNonlinearSolver");
  } else {
    J.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    matrix.reset(check_setup(SUNDenseMatrix(n, n, context.get()), "SUNDenseMatrix"));
    linear = detail::make_dense_solver(n, context.get());
    check_setup(CVodeSetLinearSolver(cvode.get(), linear.get(), matrix.get()),
                "CVodeSetLinearSolver");
    check_setup(CVodeSetLinSysFn(cvode.get(), matrix_call), "CVodeSetLinSysFn");
  }
}

int Cvode::Impl::rhs_call(double tau, N_Vector y, N_Vector y_dot, void* self) noexcept {
  Impl& me = *static_cast<Impl*>(self);
  return me.guard.rhs(me.rhs, me.time(tau), NV_DATA_S(y), NV_DATA_S(y_dot), me.n);
}

/// A = I - gamma J; J is computed anew unless CVODE is content with the last one.
int Cvode::Impl::matrix_call(double tau, N_Vector y, N_Vector, SUNMatrix A, booleantype reuse,
                             booleantype* computed, double gamma, void* self, N_Vector, N_Vector,
                             N_Vector) noexcept {
  Impl& me = *static_cast<Impl*>(self);
  *computed = reuse ? SUNFALSE : SUNTRUE;
  if (!reuse) {
    ++me.jacobian_calls;
    std::fill(me.J.begin(), me.J.end(), 0.0);
    if (me.guard.jacobian(me.jacobian, me.time(tau), NV_DATA_S(y), me.J.data(), me.n) != 0)
      return -1;
  }
  double* a = SM_DATA_D(A);
  for (std::size_t i = 0; i < me.J.size(); ++i) a[i] = -gamma * me.J[i];
  for (int i = 0; i < me.n; ++i) a[i * me.n + i] += 1.0;
  return 0;
}

int Cvode::Impl::weights_call(N_Vector y, N_Vector weights, void* self) noexcept {
  const Impl& me = *static_cast<const Impl*>(self);
  const double* value = NV_DATA_S(y);
  double* w = NV_DATA_S(weights);
  for (int i = 0; i < me.n; ++i) {
    const double allowed =
        me.options.rel_tol * std::abs(value[i]) + me.abs_tol[static_cast<std::size_t>(i)];
    if (!(allowed > 0.0)) return -1;
    w[i] = 1.0 / allowed;
  }
  return 0;
}

void Cvode::Impl::message_call(int, const char*, const char*, char* text, void* self) noexcept {
  Impl& me = *static_cast<Impl*>(self);
  std::snprintf(me.message, sizeof me.message, "%s", text);
}

long Cvode::Impl::steps() const {
  long steps = 0;
  CVodeGetNumSteps(cvode.get(), &steps);
  return steps;
}

OdeStats Cvode::Impl::current() const {
  OdeStats s{steps(), 0, jacobian_calls, 0};
  CVodeGetNumRhsEvals(cvode.get(), &s.rhs_calls);
  CVodeGetNumErrTestFails(cvode.get(), &s.error_test_failures);
  return s;
}

void Cvode::Impl::begin(double from, const double* y0, double stop, double first_step) {
  DRIFT_DEMAND(rhs && (method == Method::adams || jacobian));
  DRIFT_EXPECTS(stop >= from);
  t0 = t = from;
  t_stop = stop;
  at_stop = !(stop > from);
  failure = {};
  guard.clear();
  message[0] = '\0';
  jacobian_calls = 0;
  std::copy(y0, y0 + n, NV_DATA_S(y.get()));
  check_setup(CVodeReInit(cvode.get(), 0.0, y.get()), "CVodeReInit");
  check_setup(CVodeSetInitStep(cvode.get(), first_step), "CVodeSetInitStep");
  // A step that cannot move time at t_stop is no step: ends the creeping "t + h = t".
  double least = 4.0 * std::numeric_limits<double>::epsilon() * (stop - from);
  if (longest > 0.0) least = std::min(least, longest);
  check_setup(CVodeSetMaxStep(cvode.get(), 0.0), "CVodeSetMaxStep");  // below it no least is set
  check_setup(CVodeSetMinStep(cvode.get(), least), "CVodeSetMinStep");
  check_setup(CVodeSetMaxStep(cvode.get(), longest), "CVodeSetMaxStep");
  if (const int bad = detail::first_nonfinite(y0, n); bad >= 0)
    fail(OdeStatus::rhs_nonfinite,
         fmt::format("initial state {} is not finite at t = {:.9g} s", bad, t0));
}

OdeResult Cvode::Impl::advance(double t_out) {
  if (!failure.ok()) return failure;
  DRIFT_EXPECTS(t_out >= t || t_out >= t_stop);
  const double target = std::min(t_out, t_stop);
  if (at_stop || !(target > t)) return {OdeStatus::ok, t, {}};

  double tau_now = 0.0;
  CVodeGetCurrentTime(cvode.get(), &tau_now);
  const long left = options.max_steps - steps();
  if (left <= 0 && target - t0 > tau_now) return fail(CV_TOO_MUCH_WORK);
  CVodeSetMaxNumSteps(cvode.get(), std::max(left, 1L));
  // CVODE drops its stop time when it reaches it within rounding.
  CVodeSetStopTime(cvode.get(), t_stop - t0);
  double tau = 0.0;
  const int flag = CVode(cvode.get(), target - t0, y.get(), &tau, CV_NORMAL);
  if (flag < 0 || guard.failed()) return t = time(tau), fail(flag);
  at_stop = flag == CV_TSTOP_RETURN;
  t = target;
  return {OdeStatus::ok, t, {}};
}

OdeResult Cvode::Impl::fail(OdeStatus status, std::string cause) {
  return failure = {status, t, std::move(cause)};
}

OdeResult Cvode::Impl::fail(int flag) {
  if (guard.failed()) return failure = guard.failure();
  double tau = 0.0;
  CVodeGetCurrentTime(cvode.get(), &tau);
  t = time(tau);
  switch (flag) {
    case CV_TOO_MUCH_WORK:
      return fail(OdeStatus::too_many_steps,
                  fmt::format("{} steps are used up at t = {:.9g} s", options.max_steps, t));
    case CV_TOO_MUCH_ACC:
      return fail(
          OdeStatus::tolerance_too_tight,
          fmt::format("the tolerances ask for more than double precision at t = {:.9g} s", t));
    case CV_ERR_FAILURE:
    case CV_CONV_FAILURE:
      return fail(OdeStatus::step_too_small,
                  fmt::format("{} fails however short the step at t = {:.9g} s",
                              flag == CV_ERR_FAILURE ? "the error test" : "the corrector", t));
    default:
      return fail(OdeStatus::solver_failed,
                  fmt::format("CVODE flag {} at t = {:.9g} s: {}", flag, t, message));
  }
}

Cvode::Cvode(Method method, int n, const OdeOptions& options)
    : Cvode(method, options, std::vector<double>(static_cast<std::size_t>(n), options.abs_tol)) {}
Cvode::Cvode(Method method, const OdeOptions& options, std::span<const double> abs_tol)
    : impl_(std::make_unique<Impl>(method, static_cast<int>(abs_tol.size()), options,
                                   std::vector<double>(abs_tol.begin(), abs_tol.end()))) {}
Cvode::~Cvode() = default;
Cvode::Cvode(Cvode&&) noexcept = default;
Cvode& Cvode::operator=(Cvode&&) noexcept = default;

void Cvode::system(OdeRhs rhs, OdeJacobian jacobian) {
  impl_->rhs = rhs;
  impl_->jacobian = jacobian;
}

void Cvode::start(double t0, const double* y0, double t_stop, double first_step) {
  impl_->guard.start_clock(impl_->options.wall_limit);
  impl_->begin(t0, y0, t_stop, first_step);
}

void Cvode::limit_steps(double longest) {
  const double most = impl_->options.max_step;
  impl_->longest = longest > 0.0 && most > 0.0 ? std::min(longest, most) : std::max(longest, most);
}

OdeResult Cvode::advance(double t_out) {
  return impl_->advance(t_out);
}
std::span<const double> Cvode::state() const {
  return {NV_DATA_S(impl_->y.get()), static_cast<std::size_t>(impl_->n)};
}
OdeStats Cvode::stats() const {
  return impl_->current();
}
int Cvode::size() const {
  return impl_->n;
}

}  // namespace drift
