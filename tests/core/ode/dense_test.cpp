#include "core/ode/dense.hpp"

#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "core/base/linalg.hpp"
#include "core/ode/vector_ops.hpp"

namespace drift::detail::dense_test {
namespace {

TEST(Dense, SolvesWhatEigenSolvesWithPivoting) {
  const auto context = make_context();
  std::srand(1);
  for (const int n : {1, 2, 3, 12, 15, 40}) {
    MatX A = MatX::Random(n, n);
    if (n > 1) A(0, 0) = 0.0;  // the first pivot must be sought
    const VecX b = VecX::Random(n);
    const MatrixPtr matrix(SUNDenseMatrix(n, n, context.get()));
    Eigen::Map<MatX>(SM_DATA_D(matrix), n, n) = A;
    const VectorPtr right = make_vector(n, context.get()), x = make_vector(n, context.get());
    Eigen::Map<VecX>(NV_DATA_S(right), n) = b;
    const auto solver = make_dense_solver(n, context.get());
    ASSERT_EQ(SUNLinSolSetup(solver.get(), matrix.get()), 0);
    ASSERT_EQ(SUNLinSolSolve(solver.get(), matrix.get(), x.get(), right.get(), 0.0), 0);
    const VecX found = Eigen::Map<VecX>(NV_DATA_S(x), n);
    // Backward stable: |A x - b| <= n eps growth |A| |x|; growth is below n for these.
    EXPECT_LT((A * found - b).norm(), 1e-16 * n * n * 10.0 * A.norm() * found.norm()) << n;
    EXPECT_EQ(Eigen::Map<VecX>(NV_DATA_S(right), n), b);
    ASSERT_EQ(SUNLinSolSolve(solver.get(), matrix.get(), right.get(), right.get(), 0.0), 0);
    EXPECT_EQ(Eigen::Map<VecX>(NV_DATA_S(right), n), found) << "in place";
  }
}

TEST(Dense, ASingularMatrixIsReportedByItsColumn) {
  const auto context = make_context();
  const MatrixPtr matrix(SUNDenseMatrix(3, 3, context.get()));
  Eigen::Map<Mat3> A(SM_DATA_D(matrix));
  A << 1, 2, 3, 2, 4, 6, 0, 1, 1;
  A(2, 1) = 0.0;
  const auto solver = make_dense_solver(3, context.get());
  EXPECT_EQ(SUNLinSolSetup(solver.get(), matrix.get()), 2);
  A = Mat3::Identity();
  EXPECT_EQ(SUNLinSolSetup(solver.get(), matrix.get()), 0);
}

}  // namespace
}  // namespace drift::detail::dense_test
