#pragma once

#include "analysis/inference/marginal.hpp"
#include "analysis/inference/whitener.hpp"

namespace drift::inference {

/// Everything the data say of candidates once the nominal parameters are fitted:
/// g ~ N(C a, C) for candidate amplitudes a in prior sigmas, the parameters marginalised with their
/// prior.
struct Projected {
  MatX C;    ///< shape (K, K): S' V^-1 S, information on the candidates that is left
  VecX g;    ///< shape K: S' V^-1 r0
  VecX raw;  ///< shape K: information before the parameters took their part

  double absorbed(Eigen::Index k) const { return raw[k] > 0.0 ? 1.0 - C(k, k) / raw[k] : 1.0; }
};

/// The restricted likelihood of a linearised test under one noise, and what it says of candidates.
///
/// Rows are whitened (noise and attitude), T = whitened theta; with A = I + T'T = L L' and
/// h(u) = L^-1 T' u, u' V^-1 w = u'w - h(u)'h(w) for whitened columns u, w (Woodbury) and
/// log det V = log det of the noise + log det A.
class Projector {
 public:
  Projector(const LinearProblem& problem, const NoiseModel& noise);

  const Whitener& whitener() const { return whitener_; }
  /// Whitened.
  auto theta() const { return white_.leftCols(n_); }
  auto extra() const { return white_.middleCols(n_, white_.cols() - n_ - 1); }
  auto r0() const { return white_.col(white_.cols() - 1); }

  const Marginal& marginal() const { return marginal_; }
  /// All candidates of the problem, against all rows.
  Projected candidates() const;
  /// The same, but C of each group of columns alone; NaN between groups.
  Projected candidates_in(const std::vector<std::vector<int>>& groups) const;
  /// Some of them, in the order given.
  Projected candidates(const std::vector<int>& columns) const;

  /// Further columns (a scan) that stand for rows first, first + 1, ..., not whitened: their own C,
  /// g and cross information with the candidates, parameters projected out.
  struct Scan {
    MatX C;       ///< shape (L, L)
    MatX cross;   ///< shape (L, K)
    VecX g, raw;  ///< shape L
  };
  Scan scan(const MatX& columns, Eigen::Index first) const;
  /// The same without the cross information, which is nearly all of the work.
  Scan scan_alone(const MatX& columns, Eigen::Index first) const;

  /// Other data of the same test in the place of r0, a recording per column, not whitened.
  struct Replay {
    VecX log_likelihood2;  ///< of each recording
    MatX g;                ///< shape (K, recordings)
  };
  Replay replay(const MatX& recordings) const;

  /// Whitened columns with the parameters taken out at their best: (1 - T A^-1 T') columns.
  MatX clean(const Eigen::Ref<const MatX>& whitened) const;
  VecX clean_residual() const { return clean(r0()); }
  MatX clean_extra(const std::vector<int>& columns) const {
    return clean(extra()(Eigen::all, columns));
  }

  /// Frees what is known of candidates alone, nearly all of the memory: extra() is empty then.
  void forget_candidates();

  /// Scaled parameters at their best, and their covariance.
  struct Fit {
    VecX x;
    MatX covariance;
  };
  Fit fit() const;

 private:
  /// first: row that the first one of `whitened` stands for.
  MatX h(const Eigen::Ref<const MatX>& whitened, Eigen::Index first) const;
  /// Of whitened columns and their h.
  Scan scanned(const MatX& white, const MatX& half, Eigen::Index first) const;

  Whitener whitener_;
  Eigen::Index n_;  ///< parameters
  MatX white_;      ///< [theta, extra, r0], whitened
  MatX L_;
  MatX half_;  ///< h of [extra, r0], shape (n, K + 1)
  Marginal marginal_;
};

}  // namespace drift::inference
