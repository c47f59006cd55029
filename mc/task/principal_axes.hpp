#pragma once

#include <Eigen/Eigenvalues>

#include "core/base/linalg.hpp"

namespace drift::mc {

/// Variances along the eigenvectors of a covariance, and how far a vector reaches along each,
/// without the eigenvectors: what turns the covariance into a diagonal matrix turns the vector
/// along. The reduction to three diagonals costs 4/3 n^3; what follows it, n^2 (Golub and Welsch,
/// Math. Comp. 23, 1969). Allocates only when built.
class PrincipalAxes {
 public:
  explicit PrincipalAxes(Eigen::Index n) : tridiagonal_(n), variance_(n), beside_(n), along_(n) {}

  /// P symmetric, shape (n, n). False if the iteration does not converge: P is not finite.
  template <class Matrix>
  bool compute(const Matrix& P, const VecX& v) {
    tridiagonal_.compute(P);
    return diagonalise(v);
  }
  /// In no order; both belong to the same eigenvector.
  const VecX& variance() const { return variance_; }
  const VecX& along() const { return along_; }

 private:
  bool diagonalise(const VecX& v);
  void step(Eigen::Index start, Eigen::Index end);

  Eigen::Tridiagonalization<MatX> tridiagonal_;
  VecX variance_, beside_, along_;
};

}  // namespace drift::mc
