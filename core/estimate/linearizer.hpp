#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/estimate/gimbal_prediction.hpp"
#include "core/estimate/layout.hpp"
#include "core/estimate/rate_chain.hpp"
#include "core/estimate/rows3.hpp"
#include "core/physics/slot_derivatives.hpp"
#include "core/plan/readout.hpp"
#include "core/sim/trajectory.hpp"

namespace drift {

/// Derivatives at one node, with respect to the attitude error psi_i (R_ip = exp([psi_i x]) R_ip,
/// axes of the chain's inertial frame i) and to the scaled states of a layout. Rows over states are
/// filled up with zeros to whole lanes.
struct NodeJacobian {
  Mat3 A;                          ///< d psi_i' / d psi_i [1/s]
  Rows3 B;                         ///< d psi_i' / d rate states [rad/s]
  Vec3 omega_ip_i = Vec3::Zero();  ///< inertial rate of the platform, as the model has it [rad/s]
  Vec3 acc;                        ///< accelerometer outputs [g]
  Mat3 H;                          ///< d acc / d psi_i [g/rad]
  Rows3 H_par;                     ///< d acc / d readout states [g]
};

/// Where to linearise: a node of an interval, the platform's rotation vector there [rad], and the
/// memory, null where no term of the model has any.
struct NodePoint {
  const Node* node = nullptr;
  const Interval* interval = nullptr;
  Vec3 phi = Vec3::Zero();
  const MemoryPoint* memory = nullptr;
};

/// Works out NodeJacobian from the derivatives of the terms' slots: each active term is evaluated
/// once with three derivatives of attitude and once for each of its groups of parameters, and one
/// formula chains the slots to the platform's rate for every coupling (RateChain). As many nodes as
/// the machine handles at once are worked out together; terms that ask for more than attitude and
/// command see them one after the other. Holds the workspace, so that an evaluation allocates
/// nothing.
class Linearizer {
 public:
  static constexpr std::size_t at_once = static_cast<std::size_t>(Pack::width);

  Linearizer(const DriftModel& model, const Layout& layout, Readout readout);

  void set_theta(const Theta& theta);
  /// evaluate() leaves the readout part as it is until the other is called: where nothing was
  /// measured nobody asks for it.
  void leave_readout_out() { with_readout_ = false; }
  void work_readout_out() { with_readout_ = readout_.accelerometers; }
  /// Rate part (A, B) and, if accelerometers are read, readout part (acc, H, H_par) at some nodes,
  /// at most at_once, where the same is commanded. Each comes out as it would alone.
  /// timeline and memory: may be null where no term of the model asks for more than attitude and
  /// command.
  void evaluate(std::span<const NodePoint> points, const Mat3& E_loop, const Timeline* timeline,
                NodeJacobian* out);
  /// Gimbal angles at a node and their derivatives with respect to psi_i and to the readout states;
  /// the case heads as at the end of the node's interval.
  GimbalPrediction gimbals(const Timeline& timeline, const NodePoint& point);
  NodeJacobian make() const;
  const Layout& layout() const { return layout_; }

 private:
  using D3 = Dual<3>;
  using Vec3D = Vec3T<D3>;
  using PackD = Dual<3, Pack>;

  void look(const NodePoint& point, const Mat3& R_lp, const Timeline* timeline);
  void look_together(std::span<const NodePoint> points);
  void differentiate_rates(std::span<const NodePoint> points, const Mat3& E_loop,
                           const Timeline* timeline, NodeJacobian* out);
  void differentiate_readout(std::span<const NodePoint> points, const Timeline* timeline,
                             NodeJacobian* out);
  void differentiate_offset_readout(const Mat3& R_il, NodeJacobian& out);
  Vec3D offset() const;

  /// A hook of the terms, of those that are worked out together and of the others.
  template <class Hook>
  struct Hooked {
    SlotDerivatives<Hook, Pack> together;
    SlotDerivatives<Hook, double> apart;
    std::vector<Pack> derivative;  ///< work: of the entries of the first
    std::vector<Pack> beside;      ///< of the second

    Hooked(const TermMask& terms, const Mounting& mounting, const std::vector<std::size_t>& states)
        : together(those_in_lanes(terms), mounting, states),
          apart(those_apart(terms), mounting, states),
          derivative(together.entries().size()),
          beside(apart.entries().size()) {}
  };
  template <class Hook>
  typename SlotDerivatives<Hook, Pack>::Slots slots_of(Hooked<Hook>& hooked,
                                                       std::span<const NodePoint> points,
                                                       const Timeline* timeline);

  DriftModel model_;
  Layout layout_;
  Readout readout_;
  bool with_readout_ = true;
  Needs needs_;
  Theta theta_;
  std::vector<Pack> theta_together_;
  Hooked<RatesHook> rates_;
  Hooked<ReadoutHook> accelerometers_;
  SlotDerivatives<ReadoutHook, double> offset_accelerometers_;
  SlotDerivatives<OffsetHook, double> offsets_;
  SlotDerivatives<GimbalsHook, double> resolvers_;
  SeenByTerms<Pack> together_;
  Mat3T<Pack> R_lp_, R_il_;
  SeenByTerms<double> seen_;
  Surroundings<double> around_still_;  ///< filled if needed
  Surroundings<D3> around_at_psi_;
  Mat3T<D3> R_at_psi_;              ///< R_lp with its derivatives
  std::vector<double> derivative_;  ///< work: of the entries of a hook
};

}  // namespace drift
