#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift {

/// What whitened rows [t | e | zeros] say of n parameters of which nothing is known but that they
/// are zero within one: the normal equations (1 + sum t^T t) x = sum t^T e + prior. Solved by
/// Cholesky; rounding enters with the square of the condition, which the prior bounds.
class Information {
 public:
  /// width: of a row, whole lanes, more than n.
  Information(std::size_t parameters, std::size_t width);

  void clear();
  /// Adds `count` rows that lie one after the other.
  void add(const double* rows, std::size_t count);

  /// Factorises 1 + information. False if it is not finite.
  bool factorise();
  /// x for a prior mean, after factorise(); until the next time.
  const VecX& solve(const VecX& prior);
  /// d^T (1 + information) d.
  double length_squared(const VecX& d) const;
  /// t (1 + information)^-1 t^T of a row t.
  double variance_of(const double* t) const;
  /// u (1 + information)^-1 t^T of two rows.
  double covariance_of(const double* u, const double* t) const;
  /// (1 + information)^-1, written into P, shape (n, n).
  void invert(MatX& P) const;
  /// Minimum of the cost, sum (t x - e)^2 + |x - prior|^2, at its solution x.
  double cost(const VecX& x, const VecX& prior) const;
  /// Entry of sum [t | e]^T [t | e].
  double operator()(std::size_t i, std::size_t k) const { return sum_[i * width_ + k]; }

 private:
  std::size_t n_, width_;
  std::vector<double> sum_;  ///< rows by columns, from the diagonal on
  MatX matrix_;
  VecX solution_;
  mutable Eigen::Matrix<double, Eigen::Dynamic, 2> work_;
  Eigen::LLT<MatX> factor_;
};

}  // namespace drift
