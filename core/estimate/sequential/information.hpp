#pragma once

#include <vector>

#include "core/base/linalg.hpp"

namespace drift {

/// What whitened rows [t | e | zeros] say of n parameters of which nothing is known beforehand but
/// that they are zero within one: the normal equations (1 + sum t^T t) x = sum t^T e + prior,
/// solved by Cholesky. Rounding enters with the square of the condition, which the prior bounds.
class Information {
 public:
  /// How wide a row of n parameters is: its right hand side, and zeros up to whole lanes and to
  /// whole blocks of four, which are summed up together.
  static std::size_t row_width(std::size_t parameters);

  /// width: of a row, row_width() of as many parameters.
  Information(std::size_t parameters, std::size_t width);

  void clear();
  /// Adds `count` rows that lie one after the other.
  void add(const double* rows, std::size_t count);

  /// Sum of t P w^T over `count` rows t, of `rows`, and w, of `others`; P symmetric, shape (n, n).
  double product(const double* rows, const double* others, std::size_t count, const MatX& P);

  /// Factorises 1 + information = U^T U. False if it is not positive definite, or not finite.
  bool factorise();
  /// x for a prior mean, after factorise(); until the next time.
  const VecX& solve(const VecX& prior);
  /// Minimum of the cost, sum (t x - e)^2 + |x - prior|^2, at its solution x.
  double cost(const VecX& x, const VecX& prior) const;
  /// Of 1 + information, after factorise().
  double log_det() const;
  /// (1 + information)^-1, written into P, shape (n, n).
  void invert(MatX& P);

  /// Rows t <- t U^-1 in place, their right hand sides as they are: of such rows u and w, u w^T is
  /// what t (1 + information)^-1 t'^T was.
  void whiten(double* rows, std::size_t count) const;
  /// t (1 + information)^-1 t^T.
  double variance_of(const double* t);
  /// U d: with whitened rows in place of t, t d stays what it was.
  const VecX& whitened(const VecX& d);

 private:
  const double* factor(std::size_t i) const { return factor_.data() + i * width_; }

  std::size_t n_, width_;
  std::vector<double> sum_;     ///< rows by columns, from the diagonal on
  std::vector<double> factor_;  ///< U, zero from column n on and (where read) below the diagonal
  std::vector<double> work_;
  std::vector<double> inverse_diagonal_;
  VecX solution_, turned_;
};

}  // namespace drift
