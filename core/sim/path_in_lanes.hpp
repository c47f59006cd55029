#pragma once

#include "core/physics/slot_derivatives.hpp"
#include "core/sim/trajectory.hpp"

namespace drift {

/// The platform's path over several intervals at once, by Picard's iteration: its rate at all nodes
/// of a piece, as many in lock step as the machine handles, and the integral of the polynomials
/// through five of them. In inertial axes the rate hardly depends on the attitude (of an error,
/// less than a thirtieth is left after a round), so a few rounds do where Runge and Kutta go from
/// node to node. Agrees with them to their own accuracy. For models whose terms ask for attitude
/// and command alone (all_in_lanes).
class PathInLanes {
 public:
  /// The timeline must outlive it.
  PathInLanes(const Timeline& timeline, const DriftModel& model);

  void set_theta(const Theta& theta);
  /// phi at the nodes of the intervals first to end - 1, which are of one chain. Given at the
  /// beginning of the first one; phi: rotation vectors at every node of the timeline [rad].
  /// Allocates nothing once it has seen the longest piece.
  void forward(std::size_t first, std::size_t end, Vec3* phi);
  /// The same, given at the end of the last one.
  void backward(std::size_t first, std::size_t end, Vec3* phi);
  /// The whole timeline, from the initial attitude error of each chain on, local axes [rad].
  void all_forward(const std::vector<Vec3>& psi0_l, Vec3* phi);

 private:
  /// As many nodes as are worked out in lock step; in the lanes that are left, the last once more.
  struct Lane {
    Mat3T<Pack> R_lr, R_ir;
    Vec3T<Pack> omega_ic_l;
    Vec3T<Pack> psi, rate;  ///< attitude against the reference, inertial axes [rad]; [rad/s]
  };
  enum class Given { at_beginning, at_end };
  /// Into pieces in which the same is commanded, of not too many nodes.
  void cut(std::size_t first, std::size_t end);
  void solve_piece(std::size_t first, std::size_t end, Given given, Vec3* phi);
  void gather(std::size_t first, std::size_t end);
  void find_rate(Lane& lane);
  double round(std::size_t anchor);
  bool evenly_spaced(std::size_t from) const;
  void step_by_step(std::size_t first, std::size_t end, Given given, Vec3* phi) const;

  const Timeline& timeline_;
  DriftModel model_;
  SlotDerivatives<RatesHook, Pack> terms_;
  SeenByTerms<Pack> seen_;
  Theta theta_;
  std::vector<Pack> theta_together_;
  Vec3 omega_cmd_p_ = Vec3::Zero();  ///< of the piece
  Mat3 E_loop_ = Mat3::Zero();
  std::vector<std::size_t> cuts_;
  std::vector<std::size_t> node_;  ///< of the timeline; of two at the same instant, the first
  std::vector<double> t_, step_;   ///< of each node; from it to the next [s]
  std::vector<Vec3> psi_;
  std::vector<Lane> lanes_;
};

/// The platform's motion over a whole timeline, in lanes where the model's terms allow it, step by
/// step where they do not. psi0_l: initial attitude error of each chain, local axes [rad].
Trajectory integrate(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                     const std::vector<Vec3>& psi0_l);

}  // namespace drift
