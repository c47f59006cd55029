#pragma once

#include <cstdint>

#include "analysis/inference/projector.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::inference {

/// What a test statistic needs of a set of columns: T = |W' g|^2 of `dof` degrees.
struct Contrast {
  std::vector<int> columns;
  MatX W;  ///< shape (columns, dof): C^-1/2 on what is observable of them
  int dof = 0;
  double T(const VecX& g) const;
};

/// Directions of `columns` whose information is above VisibleLimits::information and above `raw` by
/// rounding.
Contrast make_contrast(const MatX& C, const VecX& raw, const std::vector<int>& columns);

/// Distribution of the largest strength of many contrasts under the null, g ~ N(0, C)
/// (Westfall and Young 1993: single-step max-T), by simulation with a fixed stream.
class MaxNull {
 public:
  /// stream: number of the family, so that families draw different numbers.
  MaxNull(const MatX& C, const std::vector<Contrast>& contrasts, int draws, std::uint64_t stream);
  /// A family of nothing: its maximum is zero.
  MaxNull() = default;
  /// From maxima that were drawn elsewhere.
  static MaxNull of(const VecX& maxima);
  /// Draws of N(0, C), one per row, shape (draws, columns of C).
  static MatX draw(const MatX& C, int draws, std::uint64_t stream);
  /// Families joined as if independent: P(all quiet) >= product of each, for Gaussian scores
  /// (correlation inequality, Royen 2014), so the joint p-value is never too small.
  static MaxNull joined(const std::vector<MaxNull>& families);

  /// Strength that the maximum exceeds with probability alpha.
  double threshold(double alpha) const;
  /// Family-wise p-value of a strength: counted, and beyond the draws' reach by the number of
  /// independent tests that the tail is worth.
  double p_value(double strength) const;
  double log_p(double strength) const;

 private:
  std::vector<double> maxima_;              ///< ascending; of a single family
  std::vector<std::vector<double>> parts_;  ///< of joined families
  double log_tests_ = -1e300;               ///< log of the effective number of tests
  double single_p(const std::vector<double>& maxima, double strength) const;
  void calibrate();
};

}  // namespace drift::inference
