#pragma once

#include <vector>

#include "core/estimate/sequential/in_lanes/lane_linearizer.hpp"

namespace drift {

/// AttitudeFilter of several runs, one in each lane: three attitudes, nothing that walks and
/// no noise that drives.
class LaneFilter {
 public:
  /// readout: a slot of the accelerometers and the readout state it depends on.
  LaneFilter(const Layout& layout, const std::vector<LaneLinearizer::Entry>& readout);

  void reset();
  /// A new attitude, expected at psi off the reference, unknown within sigma [rad].
  void cage(const PackVec& psi, double sigma);
  /// psi <- Phi psi + G x. G: three numbers of each rate state.
  void propagate(const PackMat& Phi, const std::vector<Pack>& G);

  /// Three scalars (AttitudeFilter::Scalars). on: one where measured, else zero; nu is finite where
  /// the run is.
  struct Scalars {
    PackVec nu, on;
    PackMat H_psi;
    const std::vector<Pack>* H_rate = nullptr;  ///< three numbers of each rate state; may be null
    const std::vector<Pack>* H_par = nullptr;   ///< of each entry of `readout`; may be null
    double sigma = 0.0;
  };
  /// Takes them in; their whitened rows go where `into` says, row i of parameter k to
  /// into.at(k)[4 i] (LaneInformation, LaneCovariance).
  template <class Rows>
  void update(Scalars& scalars, Rows& into);

  /// Estimate of the attitude where the parameters are x off the reference [rad].
  PackVec attitude(const std::vector<Pack>& x) const;
  /// d psi / d parameter k, of its prior's sigma: three numbers [rad].
  const Pack* by_parameter(std::size_t k) const { return &U_[3 * k]; }
  /// Where the attitude is expected with the parameters of the reference, and its variance with
  /// known ones.
  PackVec beside_parameters() const {
    const Pack* u = by_parameter(parameters_);
    return {-u[0], -u[1], -u[2]};
  }
  const PackMat& variance() const { return P_; }
  /// The reference moves to where the attitude is estimated.
  void move_reference();

 private:
  std::size_t parameters_, rate_;
  const std::vector<LaneLinearizer::Entry>* readout_;
  std::vector<Pack> U_;    ///< three numbers of each parameter; minus the expectation behind them
  std::vector<Pack> row_;  ///< work: of the readout states, three numbers of each
  PackMat P_;
};

}  // namespace drift
