#pragma once

#include "core/estimate/compressed/compressed_dwells.hpp"
#include "core/estimate/linearize.hpp"

namespace drift {

/// Whitened rows of a stretch: what its channels read at the nodes and the derivatives of that,
/// combined as the readings are.
class StretchRows {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  explicit StretchRows(const Layout& layout);

  /// Sensitivities along the nodes of a stretch, whose Jacobians are given (compare
  /// propagate_sensitivity): integrals of the polynomials through all of them.
  void propagate(const StretchReadings& stretch, const Interval& interval,
                 const NodeJacobian* jacobian, IntervalSensitivity& out);
  /// Rows of the three axes of a channel, one after the other, over [attitude at the beginning
  /// | rate states | readout states | residual]. Derivatives of what is predicted; the residual is
  /// measured minus predicted. sensitivity: along the nodes of the stretch; memory: of the
  /// interval, null where no term of the model has any.
  const Rows& accelerometers(const StretchChannel& channel, const Interval& interval,
                             const IntervalSensitivity& sensitivity);
  const Rows& gimbals(const StretchChannel& channel, const Timeline& timeline,
                      const Interval& interval, const IntervalSensitivity& sensitivity,
                      const Vec3* phi, const MemoryPoint* memory, Linearizer& linearizer);
  /// Information on a state, at most, in the last two polynomials of what was worked out last: what
  /// was cut off holds less. Information of the prior is one.
  double tail() const { return tail_; }
  /// A tail that changes no sigma by more than a ten thousandth.
  static constexpr double negligible = 1e-4;

 private:
  /// Derivatives of one node's output, and what is predicted beyond the channel's reference.
  void put(Eigen::Index node, const IntervalSensitivity& sensitivity, const Mat3& H,
           const Rows3& H_par, const Vec3& predicted);
  const Rows& combined(const StretchChannel& channel, Rows& out);

  Eigen::Index rate_, readout_;   ///< states
  std::array<Rows, 3> at_nodes_;  ///< of each axis; what is predicted in the last column
  Rows3 by_rate_;
  Rows turned_back_, integral_;  ///< of rate states, a node per row
  Eigen::RowVectorXd last_;
  std::array<Rows, 2> out_;
  double tail_ = 0.0;
};

}  // namespace drift
