#pragma once

#include <vector>

#include "core/estimate/layout.hpp"
#include "core/physics/earth.hpp"
#include "core/plan/readout.hpp"
#include "core/plan/test_plan.hpp"

namespace drift::observability {

/// One position of the piecewise-constant system x' = F x, y = H x: x holds the 3 attitude errors
/// psi_l (R_lp = exp([psi_l x]) R_nominal, local axes) and the parameters of a layout, each divided
/// by its prior sigma. Time is counted in pwcs_time_unit.
struct PwcsPosition {
  MatX F;  ///< shape (states, states)
  MatX Q;  ///< [H; H F; H F^2; H F^3], shape (4 outputs, states)
};

/// Unit of time in which powers of F are of comparable size [s].
inline constexpr double pwcs_time_unit = 3600.0;
/// Singular values below this part of the largest count as zero.
inline constexpr double pwcs_tolerance = 1e-9;

/// What a test with level positions and known rotations between them can tell apart.
struct PwcsRank {
  int rank = 0;
  int states = 0;
  VecX singular_values;  ///< of the stripped observability matrix, falling, shape states
  MatX V;                ///< right singular vectors, shape (states, states)
  MatX null_space;       ///< orthonormal, prior-scaled, shape (states, states - rank)
  double gap = 0.0;   ///< last counted singular value over the first not counted; infinite if none
  double leak = 0.0;  ///< largest |F_j null(Q_j)| / |F_j|: zero if the theorem applies

  /// Whether the rank is beyond doubt: nothing near the tolerance, and the theorem's condition
  /// holds.
  bool clear() const { return gap > 1e3 && leak < 1e-9; }
};

/// The positions of a plan, held level: each commanded to follow the Earth at its nominal attitude,
/// whatever law the plan gives, all parameters zero. Derivatives come from the estimators' own
/// Linearizer. psi_l' = -omega_ie x psi_l + R_lp d omega_ip.
/// H F^4 and beyond add nothing: the parameters stand still, so F obeys the characteristic equation
/// of its 3 x 3 attitude block times F. Of the readout only the choice of channels matters.
/// InputError (config) if the middle gimbal cannot be kept small.
std::vector<PwcsPosition> pwcs_positions(const TestPlan& plan, const Site& site,
                                         const ModelSpec& spec, const Readout& channels);

/// Rank of the stripped observability matrix [Q_1; Q_2; ...] of those positions, by SVD. The
/// attitude error psi_l is carried from each position to the next, as by slews that are known
/// exactly. Source: Goshen-Meskin and Bar-Itzhack, IEEE Trans. AES 28(4), 1992; physics.md 5.2.
PwcsRank pwcs_rank(const TestPlan& plan, const Site& site, const ModelSpec& spec,
                   const Readout& channels);

}  // namespace drift::observability
