#include "tests/support/forward_sensitivity.hpp"

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <vector>

#include "core/base/check.hpp"
#include "core/ode/guard.hpp"
#include "core/ode/vector_ops.hpp"

namespace drift {
namespace {

using detail::check_setup;

struct Callbacks {
  OdeRhs rhs;
  SensitivityRhs sensitivity_rhs;
  detail::Guard guard;
  MatX S, S_dot;  ///< CVODES keeps each sensitivity in a vector of its own
};

int rhs_call(double t, N_Vector y, N_Vector y_dot, void* data) noexcept {
  Callbacks& me = *static_cast<Callbacks*>(data);
  return me.guard.rhs(me.rhs, t, NV_DATA_S(y), NV_DATA_S(y_dot), static_cast<int>(me.S.rows()));
}

int sensitivity_call(int count, double t, N_Vector y, N_Vector y_dot, N_Vector* S, N_Vector* S_dot,
                     void* data, N_Vector, N_Vector) noexcept {
  Callbacks& me = *static_cast<Callbacks*>(data);
  const auto n = me.S.rows();
  for (int j = 0; j < count; ++j) std::copy_n(NV_DATA_S(S[j]), n, me.S.col(j).data());
  auto call = [&] {
    return me.sensitivity_rhs(t, NV_DATA_S(y), NV_DATA_S(y_dot), me.S.data(), me.S_dot.data());
  };
  if (me.guard.bound(call, t, me.S_dot.data(), static_cast<int>(me.S_dot.size())) != 0) return -1;
  for (int j = 0; j < count; ++j) std::copy_n(me.S_dot.col(j).data(), n, NV_DATA_S(S_dot[j]));
  return 0;
}

void silent(int, const char*, const char*, char*, void*) noexcept {}

}  // namespace

SensitivityResult integrate_with_sensitivities(OdeRhs rhs, SensitivityRhs sensitivity_rhs,
                                               const OdeOptions& options, double t0, const VecX& y0,
                                               const MatX& S0, std::span<const double> p_scale,
                                               double t1) {
  const int n = static_cast<int>(y0.size()), count = static_cast<int>(S0.cols());
  DRIFT_DEMAND(S0.rows() == n && static_cast<int>(p_scale.size()) == count && count > 0 && t1 > t0);
  Callbacks callbacks{rhs, sensitivity_rhs, {}, S0, MatX::Zero(n, count)};
  callbacks.guard.start_clock(options.wall_limit);

  const auto context = detail::make_context();
  const auto y = detail::make_vector(n, context.get());
  std::copy_n(y0.data(), n, NV_DATA_S(y.get()));
  std::vector<detail::VectorPtr> columns;
  std::vector<N_Vector> S;
  for (int j = 0; j < count; ++j) {
    S.push_back(columns.emplace_back(detail::make_vector(n, context.get())).get());
    std::copy_n(S0.col(j).data(), n, NV_DATA_S(S.back()));
  }
  const detail::NonlinearSolverPtr corrector(
      check_setup(SUNNonlinSol_FixedPoint(y.get(), 0, context.get()), "SUNNonlinSol_FixedPoint"));
  const detail::NonlinearSolverPtr sensitivity_corrector(
      check_setup(SUNNonlinSol_FixedPointSens(count, y.get(), 0, context.get()),
                  "SUNNonlinSol_FixedPointSens"));
  const detail::IntegratorPtr cvodes(
      check_setup(CVodeCreate(CV_ADAMS, context.get()), "CVodeCreate"));
  void* const memory = cvodes.get();

  std::vector<double> scale(p_scale.begin(), p_scale.end());
  check_setup(CVodeSetErrHandlerFn(memory, silent, nullptr), "CVodeSetErrHandlerFn");
  check_setup(CVodeInit(memory, rhs_call, t0, y.get()), "CVodeInit");
  check_setup(CVodeSetUserData(memory, &callbacks), "CVodeSetUserData");
  check_setup(CVodeSStolerances(memory, options.rel_tol, options.abs_tol), "CVodeSStolerances");
  check_setup(CVodeSetNonlinearSolver(memory, corrector.get()), "CVodeSetNonlinearSolver");
  check_setup(CVodeSetMaxStep(memory, options.max_step), "CVodeSetMaxStep");
  check_setup(CVodeSetMaxNumSteps(memory, options.max_steps), "CVodeSetMaxNumSteps");
  check_setup(CVodeSetStopTime(memory, t1), "CVodeSetStopTime");
  check_setup(CVodeSensInit(memory, count, CV_STAGGERED, sensitivity_call, S.data()),
              "CVodeSensInit");
  check_setup(CVodeSetSensParams(memory, nullptr, scale.data(), nullptr), "CVodeSetSensParams");
  check_setup(CVodeSensEEtolerances(memory), "CVodeSensEEtolerances");
  check_setup(CVodeSetSensErrCon(memory, SUNTRUE), "CVodeSetSensErrCon");
  check_setup(CVodeSetNonlinearSolverSensStg(memory, sensitivity_corrector.get()),
              "CVodeSetNonlinearSolverSensStg");

  double t = t0;
  const int flag = CVode(memory, t1, y.get(), &t, CV_NORMAL);
  SensitivityResult out;
  out.result.t = t;
  if (callbacks.guard.failed())
    out.result = callbacks.guard.failure();
  else if (flag == CV_TOO_MUCH_WORK)
    out.result = {OdeStatus::too_many_steps, t,
                  fmt::format("{} steps are used up", options.max_steps)};
  else if (flag < 0)
    out.result = {OdeStatus::solver_failed, t,
                  fmt::format("CVODES flag {} at t = {:.9g} s", flag, t)};
  double t_sensitivity = t;
  if (flag >= 0) check_setup(CVodeGetSens(memory, &t_sensitivity, S.data()), "CVodeGetSens");

  out.y = Eigen::Map<const VecX>(NV_DATA_S(y.get()), n);
  out.S.resize(n, count);
  for (int j = 0; j < count; ++j)
    std::copy_n(NV_DATA_S(S[static_cast<std::size_t>(j)]), n, out.S.col(j).data());
  CVodeGetNumSteps(memory, &out.stats.steps);
  CVodeGetNumRhsEvals(memory, &out.stats.rhs_calls);
  CVodeGetNumErrTestFails(memory, &out.stats.error_test_failures);
  return out;
}

}  // namespace drift
