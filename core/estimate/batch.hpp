#pragma once

#include "core/estimate/estimate_result.hpp"
#include "core/estimate/measurement_equations.hpp"

namespace drift {

/// Upper triangular square root of the information on the parameters, prior-scaled, from the data
/// alone (no parameter prior), the attitude of each chain eliminated with its prior:
/// R^T R = J^T W J. Shape (parameters, parameters).
MatX information_root(const std::vector<ChainEquations>& chains, std::size_t parameters);

/// A direction in parameter space of which the data say (almost) nothing.
struct WeakDirection {
  double information =
      0.0;         ///< eigenvalue of the prior-scaled data information; 1 = as good as the prior
  VecX direction;  ///< unit vector over the prior-scaled parameters, layout order
};

/// Information below which a test does not see a direction (physics.md 2.4): one prior sigma along
/// it is 0.001 sigma of the data, and only a thousand would be one.
inline constexpr double unseen_information = 1e-6;

/// Directions with an eigenvalue below `limit`, weakest first; by the singular values of the root,
/// so that small ones keep their digits. Below 1 the prior says more than the data. None of a root
/// that is empty or not finite.
std::vector<WeakDirection> weak_directions(const MatX& information_root, double limit);

/// What rounding may leave of a signal that is none, per prior sigma [sigma]: n eps |R|, by which
/// the rank of a matrix is told. A direction with no more is one that the test does not see at all.
double rounding_signal(const MatX& information_root);

/// How many of these directions, of this root, have no more than that.
std::size_t exactly_unseen(const std::vector<WeakDirection>& directions,
                           const MatX& information_root);

/// How a batch fit is run.
struct BatchOptions {
  int max_iterations = 40;
  double tolerance = 1e-4;  ///< largest step that counts as converged, in posterior sigmas
  /// Estimates alone leave sigmas, covariance and information empty: they cost as much as two
  /// iterations.
  enum class Result { whole, estimates } result = Result::whole;
};

/// Outcome of a batch fit.
struct BatchResult {
  EstimateResult estimate;
  std::vector<Vec3> psi0_l;  ///< initial attitude error of each chain, local axes [rad]
  MatX information_root;     ///< of the data alone, prior-scaled, see above
  double data_chi2 = 0.0;    ///< sum of squared whitened residuals
  Mat3X acc_residual;        ///< whitened, measured minus predicted, NaN where not measured
  Mat3X gimbal_residual;
};

/// Theta of a fit: what was estimated, prior means elsewhere.
Theta theta_of(const FilterSpec& filter, const BatchResult& fit);

/// Maximum a posteriori fit by Levenberg-Marquardt on whitened residuals, everything scaled by the
/// prior, steps by normal equations where rounding allows and with second order where
/// it tells, the covariance by QR; the attitude at
/// each caging is a nuisance with its own prior. The reference for the EKF: it relinearises until
/// it stands still. Angle random walk of the filter is (whiten_random_walk), that of the drift is
/// not. start: library values of the initial estimate. ContractError if what was measured has other
/// columns than the timeline intervals.
BatchResult fit_batch(const FilterSpec& filter, const MeasuredTest& test, const Theta& start,
                      const BatchOptions& options = {});
/// The same where the attitudes are known about as well: psi0_l of a fit beside this one [rad].
/// That one has found the valley of lambda, too, which fit_batch looks for at both equations. The
/// same error, also where there are others than the chains of the timeline.
BatchResult fit_batch_from(const FilterSpec& filter, const MeasuredTest& test, const Theta& start,
                           const std::vector<Vec3>& psi0_l, const BatchOptions& options = {});

}  // namespace drift
