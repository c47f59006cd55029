#include "core/base/decompose.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace drift {

Eigensystem eigensystem(const MatX& symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

RightSingular right_singular(const MatX& matrix) {
  const Eigen::JacobiSVD<MatX> svd(matrix, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

double largest_singular_value(const MatX& matrix) {
  return Eigen::JacobiSVD<MatX>(matrix).singularValues()[0];
}

Cholesky::Cholesky(const MatX& A) : llt_(A) {}

MatX Cholesky::L() const {
  return llt_.matrixL();
}

VecX Cholesky::solve(const VecX& b) const {
  return llt_.solve(b);
}

MatX Cholesky::solve(const MatX& b) const {
  return llt_.solve(b);
}

MatX Cholesky::halved(const MatX& b) const {
  return llt_.matrixL().solve(b);
}

VecX solve_symmetric(const MatX& A, const VecX& b) {
  return A.ldlt().solve(b);
}

MatX solve_symmetric(const MatX& A, const MatX& b) {
  return A.ldlt().solve(b);
}

MatX solve_least_squares(const MatX& A, const MatX& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

}  // namespace drift
