#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/estimate/covariance.hpp"
#include "core/estimate/gimbal_prediction.hpp"
#include "core/estimate/layout.hpp"
#include "core/physics/slot_derivatives.hpp"
#include "core/plan/readout.hpp"
#include "core/sim/trajectory.hpp"

namespace drift {

/// Derivatives at one node, with respect to the attitude error psi_i (R_ip = exp([psi_i x]) R_ip,
/// axes of the chain's inertial frame i) and to the scaled states of a layout.
struct NodeJacobian {
  Mat3 A;                          ///< d psi_i' / d psi_i [1/s]
  Mat3X B;                         ///< d psi_i' / d rate states, shape (3, num_rate) [rad/s]
  Vec3 omega_ip_i = Vec3::Zero();  ///< inertial rate of the platform, as the model has it [rad/s]
  Vec3 acc;                        ///< accelerometer outputs [g]
  Mat3 H;                          ///< d acc / d psi_i [g/rad]
  Mat3X H_par;                     ///< d acc / d readout states, shape (3, size - num_rate) [g]
};

/// Works out NodeJacobian from the derivatives of the terms' slots: each active term is evaluated
/// once with three derivatives of attitude and once for each of its groups of parameters, and one
/// formula chains the slots to the platform's rate for every coupling. Holds the workspace, so that
/// an evaluation allocates nothing.
class Linearizer {
 public:
  Linearizer(const DriftModel& model, const Layout& layout, Readout readout);

  void set_theta(const Theta& theta) { theta_ = theta; }
  /// evaluate() leaves the readout part as it is until the other is called: where nothing was
  /// measured nobody asks for it.
  void leave_readout_out() { with_readout_ = false; }
  void work_readout_out() { with_readout_ = readout_.accelerometers; }
  /// Rate part (A, B) and, if accelerometers are read, readout part (acc, H, H_par).
  /// timeline and memory: may be null where no term of the model asks for more than attitude and
  /// command.
  void evaluate(const Node& node, const Interval& interval, const Mat3& E_loop, const Vec3& phi,
                const Timeline* timeline, const MemoryPoint* memory, NodeJacobian& out);
  /// Gimbal angles at the end of an interval and their derivatives with respect to psi_i and to the
  /// readout states.
  GimbalPrediction gimbals(const Timeline& timeline, const Interval& interval, const Vec3& phi,
                           const MemoryPoint* memory);
  NodeJacobian make() const;

 private:
  using D3 = Dual<3>;
  using Vec3D = Vec3T<D3>;

  void look(const Node& node, const Interval& interval, const Mat3& R_lp, const Timeline* timeline,
            const MemoryPoint* memory);
  void differentiate_rate(const Mat3& E_loop, const Mat3& R_ip, const Mat3& R_il,
                          NodeJacobian& out);
  void differentiate_readout(const Mat3& R_il, NodeJacobian& out);
  Vec3D offset() const;

  DriftModel model_;
  Layout layout_;
  Readout readout_;
  bool with_readout_ = true;
  Needs needs_;
  Theta theta_;
  SlotDerivatives<RatesHook, double> rates_;
  SlotDerivatives<OffsetHook, double> offsets_;
  SlotDerivatives<ReadoutHook, double> accelerometers_;
  SlotDerivatives<GimbalsHook, double> resolvers_;
  SeenByTerms<double> seen_;
  Surroundings<double> around_still_;  ///< filled if needed
  Surroundings<D3> around_at_psi_;
  Mat3T<D3> R_at_psi_;              ///< R_lp with its derivatives
  std::vector<double> derivative_;  ///< work: of the entries of a hook
};

}  // namespace drift
