#include "core/ode/guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drift::detail {

int first_nonfinite(const double* x, int n) noexcept {
  double sum = 0.0;  // 0 times a finite number is 0; times anything else it is NaN
  for (int i = 0; i < n; ++i) sum += 0.0 * x[i];
  if (sum == 0.0) return -1;
  return static_cast<int>(std::find_if(x, x + n, [](double v) { return !std::isfinite(v); }) - x);
}

void Guard::clear() noexcept {
  status_ = OdeStatus::ok;
  thrown_ = nullptr;
}

void Guard::start_clock(double limit) noexcept {
  limit_ = limit;
  interval_ = until_look_ = 1;
  if (limit_ > 0.0) begin_ = last_ = Clock::now();
}

int Guard::fail(OdeStatus status, double t) noexcept {
  status_ = status;
  t_ = t;
  return -1;
}

// A look at the clock costs a fifth of a cheap right-hand side, so it is taken every 256 calls; but
// every call when a few calls already take a hundredth of the limit, so that the limit is kept.
bool Guard::out_of_time() noexcept {
  if (!(limit_ > 0.0) || --until_look_ > 0) return false;
  const auto now = Clock::now();
  const double since_last = std::chrono::duration<double>(now - last_).count();
  interval_ = since_last < 0.01 * limit_ ? std::min(2 * interval_, 256L) : 1L;
  until_look_ = interval_;
  last_ = now;
  return std::chrono::duration<double>(now - begin_).count() > limit_;
}

int Guard::rhs(const OdeRhs& f, double t, const double* y, double* y_dot, int n) noexcept {
  if (failed()) return -1;
  if (out_of_time()) return fail(OdeStatus::wall_time, t);
  try {
    if (!f(t, y, y_dot)) return fail(OdeStatus::rhs_failed, t);
  } catch (...) {
    thrown_ = std::current_exception();
    return fail(OdeStatus::rhs_threw, t);
  }
  component_ = first_nonfinite(y_dot, n);
  return component_ < 0 ? 0 : fail(OdeStatus::rhs_nonfinite, t);
}

int Guard::jacobian(const OdeJacobian& f, double t, const double* y, double* J, int n) noexcept {
  if (failed()) return -1;
  try {
    if (!f(t, y, J)) return fail(OdeStatus::jacobian_failed, t);
  } catch (...) {
    thrown_ = std::current_exception();
    return fail(OdeStatus::rhs_threw, t);
  }
  component_ = first_nonfinite(J, n * n);
  return component_ < 0 ? 0 : fail(OdeStatus::jacobian_failed, t);
}

int Guard::bound(FunctionRef<bool()> f, double t, const double* result, int size) noexcept {
  if (failed()) return -1;
  try {
    if (!f()) return fail(OdeStatus::rhs_failed, t);
  } catch (...) {
    thrown_ = std::current_exception();
    return fail(OdeStatus::rhs_threw, t);
  }
  component_ = first_nonfinite(result, size);
  return component_ < 0 ? 0 : fail(OdeStatus::rhs_nonfinite, t);
}

OdeResult Guard::failure() const {
  OdeResult result{status_, t_, {}};
  switch (status_) {
    case OdeStatus::rhs_failed:
      result.cause = fmt::format("the right-hand side is not computable at t = {:.9g} s", t_);
      break;
    case OdeStatus::rhs_nonfinite:
      result.cause = fmt::format("derivative {} is not finite at t = {:.9g} s", component_, t_);
      break;
    case OdeStatus::jacobian_failed:
      result.cause =
          fmt::format("the Jacobian is not computable or not finite at t = {:.9g} s", t_);
      break;
    case OdeStatus::wall_time:
      result.cause = fmt::format("the wall time of {:g} s is used up at t = {:.9g} s", limit_, t_);
      break;
    default: {
      std::string what = "an unknown exception";
      try {
        if (thrown_) std::rethrow_exception(thrown_);
      } catch (const std::exception& e) {
        what = e.what();
      } catch (...) {
      }
      result.cause = fmt::format("exception at t = {:.9g} s: {}", t_, what);
    }
  }
  return result;
}

}  // namespace drift::detail
