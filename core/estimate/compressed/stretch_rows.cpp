#include "core/estimate/compressed/stretch_rows.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/base/check.hpp"
#include "core/estimate/transition.hpp"

namespace drift {

StretchRows::StretchRows(const Layout& layout)
    : rate_(static_cast<Eigen::Index>(layout.num_rate)),
      readout_(static_cast<Eigen::Index>(layout.size() - layout.num_rate)),
      by_rate_(padded_rows(layout.num_rate)) {}

void StretchRows::propagate(const StretchReadings& stretch, const Interval& interval,
                            const NodeJacobian* jacobian, IntervalSensitivity& out) {
  const std::size_t nodes = interval.node_count();
  DRIFT_DEMAND(stretch.integral.cols() == static_cast<Eigen::Index>(nodes));
  out.begin(jacobian, nodes);
  const double h = interval.length() / (2.0 * interval.substeps);
  out.Phi[0].setIdentity();
  for (std::size_t k = 0; k + 2 < nodes; k += 2) {
    const TwoSteps steps(jacobian[k].A, jacobian[k + 1].A, jacobian[k + 2].A, h);
    out.Phi[k + 1] = steps.to_middle * out.Phi[k];
    out.Phi[k + 2] = steps.to_end * out.Phi[k];
  }
  const Eigen::Index width = jacobian->B.cols();
  turned_back_.resize(static_cast<Eigen::Index>(nodes), 3 * width);
  for (std::size_t k = 0; k < nodes; ++k) {
    sum_of_products<Sum::afresh>({out.Phi[k].inverse()}, {&jacobian[k].B}, by_rate_);
    turned_back_.row(static_cast<Eigen::Index>(k)) =
        Eigen::Map<const Eigen::RowVectorXd>(by_rate_.data(), 3 * width);
  }
  integral_.noalias() = stretch.integral * turned_back_;
  for (std::size_t k = 0; k < nodes; ++k) {
    Eigen::Map<Eigen::RowVectorXd>(by_rate_.data(), 3 * width) =
        integral_.row(static_cast<Eigen::Index>(k));
    sum_of_products<Sum::afresh>({out.Phi[k]}, {&by_rate_}, out.G[k]);
  }
}

void StretchRows::put(Eigen::Index node, const IntervalSensitivity& sensitivity, const Mat3& H,
                      const Rows3& H_par, const Vec3& predicted) {
  const auto at = static_cast<std::size_t>(node);
  const Mat3 by_attitude = H * sensitivity.Phi[at];
  sum_of_products<Sum::afresh>({H}, {&sensitivity.G[at]}, by_rate_);
  for (int a = 0; a < 3; ++a) {
    auto row = at_nodes_[static_cast<std::size_t>(a)].row(node);
    row.head<3>() = by_attitude.row(a);
    row.segment(3, rate_) = by_rate_.row(a).head(rate_);
    if (H_par.cols() > 0)
      row.segment(3 + rate_, readout_) = H_par.row(a).head(readout_);
    else
      row.segment(3 + rate_, readout_).setZero();
    row[3 + rate_ + readout_] = predicted[a];
  }
}

const StretchRows::Rows& StretchRows::accelerometers(const StretchChannel& channel,
                                                     const Interval& interval,
                                                     const IntervalSensitivity& sensitivity) {
  const auto nodes = static_cast<Eigen::Index>(interval.node_count());
  for (Rows& rows : at_nodes_) rows.resize(nodes, 3 + rate_ + readout_ + 1);
  for (Eigen::Index k = 0; k < nodes; ++k) {
    const NodeJacobian& j = sensitivity.jacobian[k];
    put(k, sensitivity, j.H, j.H_par, j.acc - channel.reference);
  }
  return combined(channel, out_[0]);
}

const StretchRows::Rows& StretchRows::gimbals(const StretchChannel& channel,
                                              const Timeline& timeline, const Interval& interval,
                                              const IntervalSensitivity& sensitivity,
                                              const Vec3* phi, const MemoryPoint* memory,
                                              Linearizer& linearizer) {
  const auto nodes = static_cast<Eigen::Index>(interval.node_count());
  for (Rows& rows : at_nodes_) rows.resize(nodes, 3 + rate_ + readout_ + 1);
  for (Eigen::Index k = 0; k < nodes; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const GimbalPrediction p =
        linearizer.gimbals(timeline, {&timeline.nodes[interval.first_node + at], &interval, phi[at],
                                      memory ? memory + 2 * at : nullptr});
    Vec3 beyond;
    for (int a = 0; a < 3; ++a) beyond[a] = angle_difference(p.angles[a], channel.reference[a]);
    put(k, sensitivity, p.H, p.H_par, beyond);
  }
  return combined(channel, out_[1]);
}

const StretchRows::Rows& StretchRows::combined(const StretchChannel& channel, Rows& out) {
  constexpr Eigen::Index last_ones = 2;
  const Eigen::Index states = 3 + rate_ + readout_;
  out.resize(channel.rows(), states + 1);
  last_.setZero(states);
  Eigen::Index done = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const StretchChannel::Axis& axis = channel.axes[a];
    const Eigen::Index count = axis.rows();
    if (count == 0) continue;
    DRIFT_DEMAND(axis.how->projection.of_nodes.cols() == at_nodes_[a].rows());
    auto rows = out.middleRows(done, count);
    rows.noalias() = axis.how->projection.of_nodes * at_nodes_[a];
    rows.col(states) = axis.measured - rows.col(states);
    last_ += rows.bottomRows(std::min(count, last_ones)).leftCols(states).colwise().squaredNorm();
    done += count;
  }
  tail_ = last_.tail(rate_ + readout_).maxCoeff();
  return out;
}

}  // namespace drift
