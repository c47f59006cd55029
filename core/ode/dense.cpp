#include "core/ode/dense.hpp"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cmath>
#include <utility>
#include <vector>

namespace drift::detail {
namespace {

struct Content {
  std::vector<int> pivot;
  sunindextype last_flag = 0;
};

Content& content(SUNLinearSolver solver) {
  return *static_cast<Content*>(solver->content);
}

SUNLinearSolver_Type type(SUNLinearSolver) {
  return SUNLINEARSOLVER_DIRECT;
}
SUNLinearSolver_ID id(SUNLinearSolver) {
  return SUNLINEARSOLVER_CUSTOM;
}

/// A = P L U in place, column by column. Returns the number of the first zero pivot (from 1) or 0;
/// CVODE answers a positive value with a shorter step.
int factor(SUNLinearSolver solver, SUNMatrix matrix) {
  const int n = static_cast<int>(SM_COLUMNS_D(matrix));
  double* A = SM_DATA_D(matrix);
  int* pivot = content(solver).pivot.data();
  for (int k = 0; k < n; ++k) {
    double* a_k = A + k * n;
    int p = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a_k[i]) > std::abs(a_k[p])) p = i;
    pivot[k] = p;
    if (!(std::abs(a_k[p]) > 0.0)) return content(solver).last_flag = k + 1, k + 1;
    if (p != k)
      for (int j = 0; j < n; ++j) std::swap(A[j * n + k], A[j * n + p]);
    const double inverse = 1.0 / a_k[k];
    for (int i = k + 1; i < n; ++i) a_k[i] *= inverse;
    for (int j = k + 1; j < n; ++j) {
      double* a_j = A + j * n;
      const double factor = a_j[k];
      if (factor == 0.0) continue;
      for (int i = k + 1; i < n; ++i) a_j[i] -= factor * a_k[i];
    }
  }
  content(solver).last_flag = 0;
  return 0;
}

int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x_vector, N_Vector b_vector, double) {
  const int n = static_cast<int>(SM_COLUMNS_D(matrix));
  const double* A = SM_DATA_D(matrix);
  const double* b = NV_DATA_S(b_vector);
  double* x = NV_DATA_S(x_vector);
  const int* pivot = content(solver).pivot.data();
  if (x != b)
    for (int i = 0; i < n; ++i) x[i] = b[i];
  for (int k = 0; k < n; ++k) std::swap(x[k], x[pivot[k]]);
  for (int k = 0; k < n; ++k)
    for (int i = k + 1; i < n; ++i) x[i] -= A[k * n + i] * x[k];
  for (int k = n - 1; k >= 0; --k) {
    x[k] /= A[k * n + k];
    for (int i = 0; i < k; ++i) x[i] -= A[k * n + i] * x[k];
  }
  return 0;
}

sunindextype last_flag(SUNLinearSolver solver) {
  return content(solver).last_flag;
}
int release(SUNLinearSolver solver) {
  if (!solver) return 0;
  delete static_cast<Content*>(solver->content);
  SUNLinSolFreeEmpty(solver);
  return 0;
}

}  // namespace

LinearSolverPtr make_dense_solver(int n, _SUNContext* context) {
  auto own = std::make_unique<Content>();
  own->pivot.resize(static_cast<std::size_t>(n));
  SUNLinearSolver solver = check_setup(SUNLinSolNewEmpty(context), "SUNLinSolNewEmpty");
  solver->ops->gettype = type;
  solver->ops->getid = id;
  solver->ops->setup = factor;
  solver->ops->solve = solve;
  solver->ops->lastflag = last_flag;
  solver->ops->free = release;
  solver->content = own.release();
  return LinearSolverPtr(solver);
}

}  // namespace drift::detail
