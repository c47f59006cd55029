#pragma once

#include <Eigen/Cholesky>

#include "core/base/linalg.hpp"

namespace drift {

// Decompositions of matrices whose size is known when the program runs. Each source that makes one
// by itself costs the compiler seconds, so they are made in one. Of a symmetric matrix the lower
// triangle is read.

/// Of a symmetric matrix: eigenvalues, ascending, and eigenvectors (columns).
struct Eigensystem {
  VecX values;
  MatX vectors;
};
Eigensystem eigensystem(const MatX& symmetric);

/// Singular values, descending, and all right singular vectors (columns).
struct RightSingular {
  VecX values;
  MatX vectors;
};
RightSingular right_singular(const MatX& matrix);
double largest_singular_value(const MatX& matrix);

/// A = L L^T of a positive definite matrix.
class Cholesky {
 public:
  explicit Cholesky(const MatX& A);
  bool definite() const { return llt_.info() == Eigen::Success; }  ///< A is
  MatX L() const;
  VecX solve(const VecX& b) const;  ///< A^-1 b
  MatX solve(const MatX& b) const;
  MatX halved(const MatX& b) const;  ///< L^-1 b

 private:
  Eigen::LLT<MatX> llt_;
};

/// A^-1 b of a symmetric matrix that may be nearly singular (L D L^T).
VecX solve_symmetric(const MatX& A, const VecX& b);
MatX solve_symmetric(const MatX& A, const MatX& b);
/// The smallest x that minimises |A x - b|, whatever the rank of A.
MatX solve_least_squares(const MatX& A, const MatX& b);

}  // namespace drift
