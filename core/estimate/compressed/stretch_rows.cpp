#include "core/estimate/compressed/stretch_rows.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/estimate/transition.hpp"

namespace drift {

StretchRows::StretchRows(const Layout& layout)
    : rate_(static_cast<Eigen::Index>(layout.num_rate)),
      readout_(static_cast<Eigen::Index>(layout.size() - layout.num_rate)),
      by_rate_(padded_rows(layout.num_rate)) {}

void StretchRows::propagate(const StretchReadings& stretch, const Interval& interval,
                            const NodeJacobian* jacobian, IntervalSensitivity& out) {
  const std::size_t nodes = interval.node_count();
  out.jacobian = jacobian;
  while (out.Phi.size() < nodes) {
    out.Phi.emplace_back();
    out.G.push_back(jacobian->B);
  }
  const double h = interval.length() / (2.0 * interval.substeps);
  out.Phi[0].setIdentity();
  for (std::size_t k = 0; k + 2 < nodes; k += 2) {
    const Mat3 &A0 = jacobian[k].A, &A1 = jacobian[k + 1].A, &A2 = jacobian[k + 2].A;
    const Mat3 to_middle = h / 12.0 * (5.0 * A0 + 8.0 * A1 - A2),
               to_end = h / 3.0 * (A0 + 4.0 * A1 + A2);
    out.Phi[k + 1] = small_exponential(magnus(to_middle, A0, A1, h)) * out.Phi[k];
    out.Phi[k + 2] = small_exponential(magnus(to_end, A0, A2, 2.0 * h)) * out.Phi[k];
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

const StretchRows::Rows& StretchRows::accelerometers(const StretchChannel& channel,
                                                     const Interval& interval,
                                                     const IntervalSensitivity& sensitivity) {
  const auto nodes = static_cast<Eigen::Index>(interval.node_count());
  for (Rows& rows : at_nodes_) rows.resize(nodes, 3 + rate_ + readout_ + 1);
  for (Eigen::Index k = 0; k < nodes; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const NodeJacobian& j = sensitivity.jacobian[at];
    const Mat3 by_attitude = j.H * sensitivity.Phi[at];
    sum_of_products<Sum::afresh>({j.H}, {&sensitivity.G[at]}, by_rate_);
    for (int a = 0; a < 3; ++a) {
      auto row = at_nodes_[static_cast<std::size_t>(a)].row(k);
      row.head<3>() = by_attitude.row(a);
      row.segment(3, rate_) = by_rate_.row(a).head(rate_);
      row.segment(3 + rate_, readout_) = j.H_par.row(a).head(readout_);
      row[3 + rate_ + readout_] = j.acc[a] - channel.reference[a];
    }
  }
  return combined(channel, out_[0]);
}

const StretchRows::Rows& StretchRows::gimbals(const StretchChannel& channel,
                                              const Timeline& timeline, const Interval& interval,
                                              const IntervalSensitivity& sensitivity,
                                              const Vec3* phi, Linearizer& linearizer) {
  const auto nodes = static_cast<Eigen::Index>(interval.node_count());
  for (Rows& rows : at_nodes_) rows.resize(nodes, 3 + rate_ + readout_ + 1);
  for (Eigen::Index k = 0; k < nodes; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const GimbalPrediction p = linearizer.gimbals(
        timeline, {&timeline.nodes[interval.first_node + at], &interval, phi[at], nullptr});
    const Mat3 by_attitude = p.H * sensitivity.Phi[at];
    sum_of_products<Sum::afresh>({p.H}, {&sensitivity.G[at]}, by_rate_);
    for (int a = 0; a < 3; ++a) {
      auto row = at_nodes_[static_cast<std::size_t>(a)].row(k);
      row.head<3>() = by_attitude.row(a);
      row.segment(3, rate_) = by_rate_.row(a).head(rate_);
      if (p.H_par.cols() > 0)
        row.segment(3 + rate_, readout_) = p.H_par.row(a).head(readout_);
      else
        row.segment(3 + rate_, readout_).setZero();
      row[3 + rate_ + readout_] = angle_difference(p.angles[a], channel.reference[a]);
    }
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
