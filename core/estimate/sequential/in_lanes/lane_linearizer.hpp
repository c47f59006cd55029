#pragma once

#include <vector>

#include "core/estimate/layout.hpp"
#include "core/estimate/sequential/in_lanes/lane_math.hpp"
#include "core/physics/slot_derivatives.hpp"
#include "core/plan/readout.hpp"
#include "core/plan/timeline.hpp"

namespace drift {

/// NodeJacobian of several runs at the same node, one in each lane. Derivatives by a state stand
/// together.
struct LaneJacobian {
  PackMat A;                ///< d psi_i' / d psi_i [1/s]
  std::vector<Pack> B;      ///< d psi_i' / d rate states, three numbers of each [rad/s]
  PackVec acc;              ///< accelerometer outputs [g]
  PackMat H;                ///< d acc / d psi_i [g/rad]
  std::vector<Pack> H_par;  ///< d acc / d readout states, of each of LaneLinearizer::readout() [g]
};

/// What Linearizer does for several instants of one run, for one instant of several runs: they
/// follow one plan, each with parameters and a path of its own. What comes out of a lane does not
/// depend on its neighbours.
class LaneLinearizer {
 public:
  using Entry = SlotDerivatives<ReadoutHook, Pack, LanesAre::runs>::Entry;

  /// Whether a model is such that its terms ask for nothing that differs between the lanes but the
  /// attitude (at_one_instant), and none acts on what the gimbals show.
  static bool can(const DriftModel& model) {
    return all_at_one_instant(model.terms) && !TermLibrary::act_on_gimbals(model.terms);
  }
  LaneLinearizer(const DriftModel& model, const Layout& layout, Readout readout);
  LaneLinearizer(const LaneLinearizer&) = delete;
  LaneLinearizer& operator=(const LaneLinearizer&) = delete;

  /// Every parameter of TermLibrary; those of lanes that are not used must be such as may be.
  std::vector<Pack>& theta() { return theta_; }
  const DriftModel& model() const { return model_; }

  void evaluate(const Timeline& timeline, const Node& node, const Interval& interval,
                const Mat3& E_loop, const PackVec& phi, LaneJacobian& out);
  /// Gimbal angles at a node, and their derivatives by psi_i; the case heads as given [rad].
  struct Gimbals {
    PackVec angles;
    PackMat H;
  };
  Gimbals gimbals(const Node& node, double heading, const PackVec& phi) const;
  LaneJacobian make() const;
  /// A slot of the accelerometers and the readout state it depends on.
  const std::vector<Entry>& readout() const { return accelerometers_.entries(); }

  /// Rotation vectors at the nodes of an interval, from one of them (or the last) on, by steps of
  /// Runge and Kutta [rad].
  void forward(const Timeline& timeline, const Interval& interval, PackVec* phi, std::size_t from);
  void backward(const Timeline& timeline, const Interval& interval, PackVec* phi);

 private:
  void look(const Timeline& timeline, const Node& node, const Interval& interval,
            const PackVec& phi);
  PackVec rate(double t, const Mat3& R_lr, const PackVec& chi);
  PackVec step(double t, double length, const Mat3& from, const Mat3& half, const Mat3& to,
               const PackVec& phi);
  void drive(const Timeline& timeline, const Interval& interval);

  DriftModel model_;
  Needs needs_;
  Layout layout_;
  Readout readout_;
  std::vector<Pack> theta_;
  SlotDerivatives<RatesHook, Pack, LanesAre::runs> rates_;
  SlotDerivatives<ReadoutHook, Pack, LanesAre::runs> accelerometers_;
  std::vector<Pack> derivative_;
  SeenByTerms<Pack> seen_;
  Surroundings<Pack> around_still_;  ///< filled if needed
  Surroundings<Dual<3, Pack>> around_at_psi_;
  PackMat R_lp_;
  const Timeline* timeline_ = nullptr;  ///< of the interval that is stepped through
  const Interval* interval_ = nullptr;
  Vec3 omega_ic_l_ = Vec3::Zero(), omega_ie_l_ = Vec3::Zero();
  Mat3 E_loop_ = Mat3::Zero();
};

}  // namespace drift
