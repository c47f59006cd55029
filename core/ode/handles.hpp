#pragma once

#include <memory>

// SUNDIALS' own headers stay in the .cpp files of this folder; pointers to its types, which it has
// named so, suffice here.
// NOLINTBEGIN(bugprone-reserved-identifier)
struct _SUNContext;
struct _generic_N_Vector;
struct _generic_SUNMatrix;
struct _generic_SUNLinearSolver;
struct _generic_SUNNonlinearSolver;
// NOLINTEND(bugprone-reserved-identifier)

namespace drift::detail {

/// Frees any SUNDIALS object by the function that belongs to it.
struct SundialsFree {
  void operator()(_SUNContext* p) const noexcept;
  void operator()(_generic_N_Vector* p) const noexcept;
  void operator()(_generic_SUNMatrix* p) const noexcept;
  void operator()(_generic_SUNLinearSolver* p) const noexcept;
  void operator()(_generic_SUNNonlinearSolver* p) const noexcept;
  void operator()(void* integrator) const noexcept;
};

using ContextPtr = std::unique_ptr<_SUNContext, SundialsFree>;
using VectorPtr = std::unique_ptr<_generic_N_Vector, SundialsFree>;
using MatrixPtr = std::unique_ptr<_generic_SUNMatrix, SundialsFree>;
using LinearSolverPtr = std::unique_ptr<_generic_SUNLinearSolver, SundialsFree>;
using NonlinearSolverPtr = std::unique_ptr<_generic_SUNNonlinearSolver, SundialsFree>;
using IntegratorPtr = std::unique_ptr<void, SundialsFree>;

/// A context of its own for one integrator; every other object must die before it.
ContextPtr make_context();

/// Setting up a solver can fail only for want of memory or by a mistake here: throws ContractError.
void check_setup(int flag, const char* what);
template <class T>
T* check_setup(T* made, const char* what) {
  check_setup(made ? 0 : -1, what);
  return made;
}

}  // namespace drift::detail
