#include "core/ode/handles.hpp"

#include <cvodes/cvodes.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sundials/sundials_nvector.h>

#include "core/base/check.hpp"

namespace drift::detail {

void SundialsFree::operator()(_SUNContext* p) const noexcept {
  SUNContext_Free(&p);
}
void SundialsFree::operator()(_generic_N_Vector* p) const noexcept {
  N_VDestroy(p);
}
void SundialsFree::operator()(_generic_SUNMatrix* p) const noexcept {
  SUNMatDestroy(p);
}
void SundialsFree::operator()(_generic_SUNLinearSolver* p) const noexcept {
  SUNLinSolFree(p);
}
void SundialsFree::operator()(_generic_SUNNonlinearSolver* p) const noexcept {
  SUNNonlinSolFree(p);
}
void SundialsFree::operator()(void* integrator) const noexcept {
  CVodeFree(&integrator);
}

void check_setup(int flag, const char* what) {
  if (flag != 0) throw ContractError(fmt::format("SUNDIALS: {} failed with flag {}", what, flag));
}

ContextPtr make_context() {
  SUNContext context = nullptr;
  check_setup(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  return ContextPtr(context);
}

}  // namespace drift::detail
