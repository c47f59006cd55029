#pragma once

#include <array>
#include <vector>

#include "core/base/dual.hpp"
#include "core/estimate/covariance.hpp"
#include "core/estimate/gimbal_prediction.hpp"
#include "core/estimate/layout.hpp"
#include "core/plan/readout.hpp"
#include "core/sim/trajectory.hpp"

namespace drift {

/// Derivatives at one node, with respect to the attitude error psi_i (R_ip = exp([psi_i x]) R_ip,
/// axes of the chain's inertial frame i) and to the scaled states of a layout.
struct NodeJacobian {
  Mat3 A;       ///< d psi_i' / d psi_i [1/s]
  Mat3X B;      ///< d psi_i' / d rate states, shape (3, num_rate) [rad/s]
  Vec3 acc;     ///< accelerometer outputs [g]
  Mat3 H;       ///< d acc / d psi_i [g/rad]
  Mat3X H_par;  ///< d acc / d readout states, shape (3, size - num_rate) [g]
};

/// Evaluates NodeJacobian by forward differentiation in chunks; holds the workspace, so that an
/// evaluation allocates nothing.
class Linearizer {
 public:
  Linearizer(const DriftModel& model, const Layout& layout, Readout readout);

  void set_theta(const Theta& theta);
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
  static constexpr int chunk = 8;
  using D = Dual<chunk>;

  /// What the terms see, as constants and with the derivatives with respect to psi_l.
  struct Seen {
    Inputs<D> still, at_psi;
    Surroundings<D> still_around, around_at_psi;  ///< filled if needed
  };

  void look(const Node& node, const Interval& interval, const Mat3& R_lp, const Timeline* timeline,
            const MemoryPoint* memory);
  template <class Sink>
  void sweep(std::size_t first_state, std::size_t count, Sink&& sink);
  void seed(std::size_t state, std::size_t k, double derivative);

  DriftModel model_;
  Layout layout_;
  Readout readout_;
  Needs needs_;
  Seen seen_;
  std::array<D, TermLibrary::num_params> theta_;
  std::array<D, num_memory> memory_;
  /// Of each state: the memory that depends on it, if any.
  struct Remembered {
    int first = 0, count = 0;
  };
  std::vector<Remembered> remembered_;
  std::array<double, num_memory> memory_derivative_{};
};

/// Sensitivities within one interval, from its start to each of its nodes:
/// psi(node k) = Phi[k] psi(start) + G[k] x(rate states).
struct IntervalSensitivity {
  std::vector<NodeJacobian> jacobian;  ///< at each node
  std::vector<Mat3> Phi;
  std::vector<Mat3X> G;
};

/// Mean of the accelerometer outputs over an interval, and its derivative with respect to the
/// attitude in the middle.
struct MeanOutput {
  Vec3 acc = Vec3::Zero();  ///< [g]
  Mat3 H = Mat3::Zero();    ///< [g/rad]
};

/// Also gathers the mean of H_par, in sensitivity.jacobian[0].H_par (it allocates nothing).
MeanOutput mean_output(const Interval& interval, IntervalSensitivity& sensitivity);

/// Fills `out` along the nodes of an interval, phi given at each.
///
/// Variation of constants: G(t) = Phi(t) Int Phi^-1 B dt with fourth-order quadrature over pairs of
/// steps; Phi is the exponential of the integral of A to second order (A t is below 1e-3 within an
/// interval: physics.md 6.5 ii).
/// memory: the points of the interval, null where the model has none.
void linearize_interval(const Interval& interval, const Timeline& timeline, const Mat3& E_loop,
                        const Vec3* phi, const MemoryPoint* memory, Linearizer& linearizer,
                        IntervalSensitivity& out);

}  // namespace drift
