#pragma once

#include "analysis/blind/rivals/rival.hpp"

namespace drift::blind {

/// A regression of the recovered platform rates, all three axes together in sigmas, on what every
/// signature would have been recovered as.
struct RateRegression {
  MatX gram;                           ///< X' X, columns of unit norm
  VecX product;                        ///< X' y
  double square = 0.0;                 ///< y' y
  double count = 0.0;                  ///< of bins
  std::vector<std::size_t> candidate;  ///< of every column

  /// Residual sum of squares of a choice of columns at their best, plus Schwarz's price for each.
  double bic(const std::vector<int>& columns) const;
};
RateRegression rate_regression(const RivalTest& test);

/// The candidates of some columns, each once.
RivalAnswer answer_of(const RateRegression& regression, const std::vector<int>& columns);

}  // namespace drift::blind
