#pragma once

#include <optional>

#include "analysis/inference/whitener.hpp"

namespace drift::inference {

/// Everything the data say of candidates once the nominal parameters are fitted (discovery.md 2.2):
/// g ~ N(C a, C) for candidate amplitudes a in prior sigmas, the parameters marginalised with their
/// prior.
struct Projected {
  MatX C;                ///< shape (K, K): information on the candidates that is left
  VecX g;                ///< shape K
  VecX raw;              ///< shape K: information before the parameters took their part
  double chi2 = 0.0;     ///< r0' P r0, of `rows` degrees under the nominal model
  double log_det = 0.0;  ///< of the marginal covariance of the rows: noise, attitude, parameters
  Eigen::Index rows = 0;

  double absorbed(Eigen::Index k) const { return raw[k] > 0.0 ? 1.0 - C(k, k) / raw[k] : 1.0; }
  /// Twice the log of the marginal likelihood, without the constant.
  double log_likelihood2() const { return -chi2 - log_det; }
};

/// Whitened columns with the nominal parameters ready to be projected out.
class Projector {
 public:
  /// Whitens [theta, extra, r0] of a problem; its later use is read only.
  Projector(const LinearProblem& problem, const NoiseModel& noise);
  /// The same for whitened rows that are given, parameters of unit prior.
  Projector(MatX theta, MatX extra, VecX r0, double log_det);

  /// Candidates of the problem against all rows.
  const Projected& candidates() const { return projected_; }

  /// Further columns (a scan), whitened from row `first` on: their own C, g and cross information
  /// with the candidates, parameters projected out.
  struct Scan {
    MatX C;       ///< shape (L, L)
    MatX cross;   ///< shape (L, K)
    VecX g, raw;  ///< shape L
  };
  Scan scan(const MatX& columns, Eigen::Index first) const;

  /// The residual with the parameters taken out at their best, whitened; and candidate columns
  /// alike: (1 - T A^-1 T') column. Shape (rows).
  VecX clean_residual() const;
  MatX clean_extra(const std::vector<int>& columns) const;
  /// Scaled parameters (best fit) with candidate columns `with` free (prior of unit variance on
  /// them left out), and their covariance; the candidates come last.
  struct Fit {
    VecX x;
    MatX covariance;
  };
  Fit fit(const std::vector<int>& with) const;

  const MatX& theta() const { return theta_; }
  const MatX& extra() const { return extra_; }
  const VecX& r0() const { return r0_; }
  const Whitener* whitener() const { return whitener_ ? &*whitener_ : nullptr; }

 private:
  void project(double log_det);
  std::optional<Whitener> whitener_;
  MatX theta_, extra_;
  VecX r0_;
  MatX L_;     ///< Cholesky factor of A = 1 + T'T
  MatX half_;  ///< L^-1 T' [extra, r0], shape (n, K + 1)
  Projected projected_;
};

}  // namespace drift::inference
