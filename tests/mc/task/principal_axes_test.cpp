#include "mc/task/principal_axes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace drift::principal_axes_test {
namespace {

/// A covariance with sigmas from 1 down to 1e-4, some of them alike, turned at random.
MatX covariance(Eigen::Index n, unsigned seed) {
  std::srand(seed);
  MatX M = MatX::Random(n, n);
  const MatX Q = M.householderQr().householderQ();
  VecX variance(n);
  for (Eigen::Index k = 0; k < n; ++k)
    variance[k] = std::pow(10.0, -8.0 * static_cast<double>(k / 2) / static_cast<double>(n));
  MatX P = Q * variance.asDiagonal() * Q.transpose();
  return 0.5 * (P + P.transpose());
}

TEST(PrincipalAxes, AreThoseOfTheEigenvectors) {
  for (const Eigen::Index n : {1, 2, 3, 17, 60}) {
    const MatX P = covariance(n, static_cast<unsigned>(n));
    const VecX v = VecX::LinSpaced(n, -1.0, 2.0);
    mc::PrincipalAxes axes(n);
    ASSERT_TRUE(axes.compute(P, v));
    const Eigen::SelfAdjointEigenSolver<MatX> eigen(P);
    VecX sorted = axes.variance();
    std::ranges::sort(sorted);
    EXPECT_LT((sorted - eigen.eigenvalues()).cwiseAbs().maxCoeff(), 1e-14) << n;
    EXPECT_NEAR(axes.along().norm(), v.norm(), 1e-12 * v.norm());
    // What lies along the axes of large variance, and the whole square in the metric of P.
    for (const double least : {1e-20, 1e-3, 0.3}) {
      double ours = 0.0, theirs = 0.0;
      for (Eigen::Index k = 0; k < n; ++k) {
        const double along = eigen.eigenvectors().col(k).dot(v);
        if (eigen.eigenvalues()[k] > least) theirs += along * along;
        if (axes.variance()[k] > least) ours += axes.along()[k] * axes.along()[k];
      }
      EXPECT_NEAR(ours, theirs, 1e-9 * v.squaredNorm()) << n << " " << least;
    }
    const double nees = (axes.along().array().square() / axes.variance().array()).sum();
    EXPECT_NEAR(nees / v.dot(P.ldlt().solve(v)), 1.0, 1e-6) << n;
  }
}

TEST(PrincipalAxes, SaysThatAMatrixIsNotFinite) {
  MatX P = covariance(5, 1);
  P(2, 3) = P(3, 2) = std::nan("");
  EXPECT_FALSE(mc::PrincipalAxes(5).compute(P, VecX::Ones(5)));
}

}  // namespace
}  // namespace drift::principal_axes_test
