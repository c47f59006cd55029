#pragma once

#include "core/estimate/gimbal_prediction.hpp"
#include "core/estimate/linearize.hpp"
#include "core/estimate/measured_test.hpp"
#include "core/estimate/stretch_jacobians.hpp"

namespace drift {

/// The whitened, linearised test of one chain: rows [J_psi, J_x, r], where r = (measured -
/// predicted) / sigma and J = d predicted / sigma; psi in units of its prior sigma, x of theirs.
struct ChainEquations {
  MatX rows;  ///< shape (measured scalars, 3 + parameters + 1)
};

/// Linearises all measurements of a test, as often as asked. Channels that are NaN are left out.
class MeasurementEquations {
 public:
  /// sigma_attitude: prior of the attitude at each caging [rad]. What the test refers to must
  /// outlive it.
  MeasurementEquations(const MeasuredTest& test, const DriftModel& model, const Layout& layout,
                       double sigma_attitude);

  const Layout& layout() const { return layout_; }
  /// About theta and the trajectory phi, chain by chain.
  std::vector<ChainEquations> at(const Theta& theta, const Trajectory& phi);

 private:
  void enter(const Interval& interval);
  void linearize(std::size_t i, const Theta& theta, const Trajectory& phi);
  void take_accelerometers(std::size_t i);
  void take_gimbals(std::size_t i, const Trajectory& phi);
  void leave(const Interval& interval);
  void add_row(double residual, const Eigen::RowVector3d& d_psi, int axis, double sigma);
  void hand_over(MatX& rows, Eigen::Index& done);

  MeasuredTest test_;
  DriftModel model_;
  Layout layout_;
  double sigma_attitude_;
  Linearizer linearizer_;
  MemoryPath memory_;
  StretchJacobians jacobians_;
  bool together_;  ///< several intervals are linearised at once
  IntervalSensitivity inner_;
  // From the caging to the start of the interval: psi = Phi psi(caging) + G x(rate states).
  Mat3 Phi_ = Mat3::Identity();
  Rows3 G_, G_next_;
  Rows3 Y_rate_, Y_par_;  ///< what a channel feels of the states
  /// Rows of a few intervals lie in the cache until they go to their columns.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> some_;
  Eigen::Index in_some_ = 0;
  std::vector<Eigen::Index> count_;  ///< rows of each chain
};

/// The same once.
std::vector<ChainEquations> measurement_equations(const MeasuredTest& test, const DriftModel& model,
                                                  const Layout& layout, const Theta& theta,
                                                  const Trajectory& phi, double sigma_attitude);

}  // namespace drift
