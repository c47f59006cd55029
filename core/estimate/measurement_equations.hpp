#pragma once

#include "core/estimate/compressed/stretch_rows.hpp"
#include "core/estimate/gimbal_prediction.hpp"
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
  /// outlive it. ContractError if what was measured has other columns than the timeline intervals.
  MeasurementEquations(const MeasuredTest& test, const DriftModel& model, const Layout& layout,
                       double sigma_attitude);
  /// The same of a test whose stretches are compressed.
  MeasurementEquations(const CompressedTest& test, const DriftModel& model, const Layout& layout,
                       double sigma_attitude);

  const Layout& layout() const { return layout_; }
  /// About theta and the trajectory phi, chain by chain.
  std::vector<ChainEquations> at(const Theta& theta, const Trajectory& phi);
  /// Stretches, by their intervals, whose polynomials were too few there: the last ones hold more
  /// than a ten thousandth of the prior's information on some parameter.
  const std::vector<std::size_t>& too_rough() const { return too_rough_; }

 private:
  MeasurementEquations(const MeasuredTest& test, const CompressedTest* compressed,
                       const DriftModel& model, const Layout& layout, double sigma_attitude);
  void enter(const Interval& interval);
  void linearize(std::size_t i, const Trajectory& phi);
  void take_accelerometers(std::size_t i);
  void take_gimbals(std::size_t i, const Trajectory& phi);
  void take_stretch(std::size_t i, const Trajectory& phi, MatX& rows, Eigen::Index& done);
  void add_rows(const StretchRows::Rows& from, MatX& rows, Eigen::Index& done);
  void leave(const Interval& interval);
  void add_row(double residual, const Eigen::RowVector3d& d_psi, int axis, double sigma);
  void hand_over(MatX& rows, Eigen::Index& done);

  MeasuredTest test_;
  const CompressedTest* compressed_;  ///< null: every interval is a sample
  DriftModel model_;
  Layout layout_;
  double sigma_attitude_;
  Linearizer linearizer_;
  MemoryRecord memory_;
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
  StretchRows stretch_;
  std::vector<std::size_t> too_rough_;
};

/// The same once.
std::vector<ChainEquations> measurement_equations(const MeasuredTest& test, const DriftModel& model,
                                                  const Layout& layout, const Theta& theta,
                                                  const Trajectory& phi, double sigma_attitude);

}  // namespace drift
