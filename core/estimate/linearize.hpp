#pragma once

#include <vector>

#include "core/estimate/linearizer.hpp"

namespace drift {

/// Nodes of the interval that has most.
std::size_t most_nodes(const Timeline& timeline);

/// Sensitivities within one interval, from its start to each of its nodes:
/// psi(node k) = Phi[k] psi(start) + G[k] x(rate states).
struct IntervalSensitivity {
  const NodeJacobian* jacobian = nullptr;  ///< at each node
  std::vector<Mat3> Phi;
  std::vector<Rows3> G;           ///< as wide as NodeJacobian::B
  std::vector<NodeJacobian> own;  ///< where linearize_interval keeps them

  /// Room for as many nodes, which `along` holds; never less than there was.
  void begin(const NodeJacobian* along, std::size_t nodes);
};

/// Mean of the accelerometer outputs over an interval, and its derivatives with respect to the
/// attitude in the middle, psi_m, and to the states: the outputs at each node k hang on the
/// attitude there, psi_k = Phi_k Phi_m^-1 (psi_m - G_m x) + G_k x.
struct MeanOutput {
  Vec3 acc = Vec3::Zero();  ///< [g]
  Mat3 H = Mat3::Zero();    ///< [g/rad]
  Rows3 H_rate;             ///< by rate states, the attitude in the middle as it is [g]
  Rows3 H_par;              ///< by readout states [g]
};

/// Fills `mean`; allocates nothing from the second time on.
void mean_output(const Interval& interval, const IntervalSensitivity& sensitivity,
                 MeanOutput& mean);

/// Fills Phi and G along the nodes of an interval, whose Jacobians are given.
///
/// Variation of constants: G(t) = Phi(t) Int Phi^-1 B dt with fourth-order quadrature over pairs of
/// steps; Phi is the exponential of Magnus' series to fourth order in the step, of the exponential
/// three terms (A t is below 1e-3 within a sample of minutes, physics.md 6.5 ii, and below 1e-2
/// within a step along a dwell). At rest on the Earth psi turns with it, and nothing else moves it.
void propagate_sensitivity(const Interval& interval, const Timeline& timeline,
                           const NodeJacobian* jacobian, IntervalSensitivity& out);

/// The same for an interval alone, phi given at each node. memory: the points of the interval, null
/// where the model has none.
void linearize_interval(const Interval& interval, const Timeline& timeline, const Mat3& E_loop,
                        const Vec3* phi, const MemoryPoint* memory, Linearizer& linearizer,
                        IntervalSensitivity& out);

}  // namespace drift
