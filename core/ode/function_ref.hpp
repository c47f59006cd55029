#pragma once

#include <memory>
#include <type_traits>

namespace drift {

template <class Signature>
class FunctionRef;

/// A callable that lives elsewhere: two pointers, no allocation. It binds to named objects only,
/// because it is kept beyond the call that takes it; the caller keeps the callable alive.
template <class R, class... Args>
class FunctionRef<R(Args...)> {
 public:
  FunctionRef() = default;

  template <class F>
  requires(!std::is_same_v<std::remove_cv_t<F>, FunctionRef> &&
           std::is_invocable_r_v<R, F&, Args...>)
      FunctionRef(F& f)  // NOLINT(google-explicit-constructor): a callable is what is asked for
      : object_(const_cast<void*>(static_cast<const volatile void*>(std::addressof(f)))),
        call_([](void* object, Args... args) -> R { return (*static_cast<F*>(object))(args...); }) {
  }

  R operator()(Args... args) const { return call_(object_, args...); }
  explicit operator bool() const { return call_ != nullptr; }

 private:
  void* object_ = nullptr;
  R (*call_)(void*, Args...) = nullptr;
};

/// y_dot = f(t, y); false when it cannot be computed there.
using OdeRhs = FunctionRef<bool(double t, const double* y, double* y_dot)>;
/// Column-major J(i, k) = d y_dot_i / d y_k at (t, y), shape n x n; false when it cannot be
/// computed.
using OdeJacobian = FunctionRef<bool(double t, const double* y, double* J)>;

}  // namespace drift
