#include <algorithm>
#include <cmath>

#include "core/estimate/batch.hpp"
#include "core/estimate/rest_rate.hpp"
#include "core/estimate/stretch_jacobians.hpp"

namespace drift {

std::vector<ChainEquations> measurement_equations(const MeasuredTest& test, const DriftModel& model,
                                                  const Layout& layout, const Theta& theta,
                                                  const Trajectory& phi, double sigma_attitude) {
  const auto& [timeline, readout, measured] = test;
  const auto n = static_cast<Eigen::Index>(layout.size());
  const auto nr = static_cast<Eigen::Index>(layout.num_rate);
  std::vector<Eigen::Index> count(timeline.chains, 0), next(timeline.chains, 0);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i)
    count[timeline.intervals[i].chain] += measured.acc.col(i).array().isFinite().count() +
                                          measured.gimbal.col(i).array().isFinite().count();
  std::vector<ChainEquations> chains(timeline.chains);
  for (int c = 0; c < timeline.chains; ++c) chains[c].rows = MatX::Zero(count[c], 3 + n + 1);

  Linearizer linearizer(model, layout, readout);
  linearizer.set_theta(theta);
  IntervalSensitivity inner;
  Mat3 Phi = Mat3::Identity();  // from the caging to the start of the interval
  Rows3 G = padded_rows(layout.num_rate), Y(3, n);
  MemoryPath memory(timeline, model);
  // Where the accelerometers were seldom read, intervals are better looked at one by one.
  const bool together = StretchJacobians::can(model) &&
                        (!readout.accelerometers || !measured.acc.array().isNaN().any());
  constexpr std::size_t at_once = 32;  // intervals
  StretchJacobians jacobians(timeline);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const Interval& interval = timeline.intervals[i];
    if (interval.cage) {
      Phi.setIdentity();
      G.setZero();
    }
    const Mat3 E_loop = misalignment_matrix(model.mounting, interval.loop);
    memory.advance(i, theta.data());
    if (together && i % at_once == 0)
      jacobians.evaluate(i, std::min(i + at_once, timeline.intervals.size()), phi.data(),
                         model.mounting, linearizer);
    const bool reads = readout.accelerometers && measured.acc.col(i).array().isFinite().any();
    if (together) {
      propagate_sensitivity(interval, timeline, jacobians.of(i), inner);
    } else {
      reads ? linearizer.work_readout_out() : linearizer.leave_readout_out();
      linearize_interval(interval, timeline, E_loop, &phi[interval.first_node], memory.points(),
                         linearizer, inner);
    }
    MatX& rows = chains[interval.chain].rows;
    const auto add_row = [&](double residual, const Eigen::RowVector3d& d_psi, const auto& d_x,
                             double sigma) {
      auto row = rows.row(next[interval.chain]++);
      row.head<3>() = d_psi * (sigma_attitude / sigma);
      row.segment(3, n) = d_x / sigma;
      row[3 + n] = residual / sigma;
    };

    if (reads) {
      Vec3 mean = Vec3::Zero();
      Mat3 Y_psi = Mat3::Zero();  // with respect to the attitude at the start of the interval
      Y.setZero();
      for (std::size_t k = 0; k < interval.node_count(); ++k) {
        const double w = Timeline::simpson_weight(interval.substeps, k);
        const NodeJacobian& j = inner.jacobian[k];
        mean += w * j.acc;
        Y_psi += w * j.H * inner.Phi[k];
        Y.leftCols(nr).noalias() += (w * j.H) * inner.G[k].leftCols(nr);
        Y.rightCols(n - nr) += w * j.H_par.leftCols(n - nr);
      }
      Y.leftCols(nr).noalias() += Y_psi * G.leftCols(nr);
      Y_psi = (Y_psi * Phi).eval();
      for (int a = 0; a < 3; ++a)
        if (std::isfinite(measured.acc(a, i)))
          add_row(measured.acc(a, i) - mean[a], Y_psi.row(a), Y.row(a),
                  interval.accelerometer_noise(readout.accelerometer_noise));
    }
    // On to the end of the interval.
    const std::size_t last = interval.node_count() - 1;
    G = (inner.Phi[last] * G + inner.G[last]).eval();
    Phi = (inner.Phi[last] * Phi).eval();
    if (readout.gimbals && measured.gimbal.col(i).array().isFinite().any()) {
      const GimbalPrediction p =
          interval.rest
              ? predict_rest_rate(interval, timeline, &phi[interval.first_node], inner)
              : linearizer.gimbals(timeline, interval, phi[interval.last_node()],
                                   memory.active() ? &memory.points()[2 * last] : nullptr);
      Y.setZero();
      Y.leftCols(nr).noalias() = p.H * G.leftCols(nr);
      if (p.H_rate.cols() > 0) Y.leftCols(nr) += p.H_rate.leftCols(nr);
      if (p.H_par.cols() > 0) Y.rightCols(n - nr) = p.H_par.leftCols(n - nr);
      const Mat3 Y_psi = p.H * Phi;
      for (int a = 0; a < 3; ++a)
        if (std::isfinite(measured.gimbal(a, i)))
          add_row(angle_difference(measured.gimbal(a, i), p.angles[a]), Y_psi.row(a), Y.row(a),
                  readout.gimbal_noise);
    }
  }
  return chains;
}

}  // namespace drift
