#include "analysis/blind/absorption.hpp"

#include <cmath>

#include "core/base/decompose.hpp"

namespace drift::blind {

Absorption::Absorption(const FilterSpec& nominal, const Timeline& timeline, const Readout& readout,
                       const Measurements& clean, const Theta& theta,
                       const std::vector<Vec3>& psi0_l)
    : timeline_(&timeline), readout_(readout) {
  const DriftModel model = nominal.model();
  const Layout layout = make_layout(nominal);
  const auto n = static_cast<Eigen::Index>(layout.size());
  const Trajectory phi = integrate_fixed(timeline, model, theta, psi0_l);
  const auto chains = measurement_equations({timeline, readout, clean}, model, layout, theta, phi,
                                            nominal.initial_attitude);
  const auto rows_of_interval = [&](std::size_t i) {
    return clean.acc.col(static_cast<Eigen::Index>(i)).array().isFinite().count() +
           clean.gimbal.col(static_cast<Eigen::Index>(i)).array().isFinite().count();
  };
  Eigen::Index rows = 0;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) rows += rows_of_interval(i);
  J_ = MatX::Zero(rows, n + 3 * timeline.chains);
  std::vector<Eigen::Index> next(chains.size(), 0);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const int c = timeline.intervals[i].chain;
    const Eigen::Index count = rows_of_interval(i);
    const MatX& e = chains[c].rows;
    J_.block(row, 0, count, n) = e.block(next[c], 3, count, n);
    J_.block(row, n + 3 * c, count, 3) = e.block(next[c], 0, count, 3);
    next[c] += count;
    row += count;
  }
  MatX A = MatX::Identity(J_.cols(), J_.cols());
  A.selfadjointView<Eigen::Lower>().rankUpdate(J_.transpose());
  L_ = Cholesky(A).L();
}

VecX Absorption::signal(const Measurements& with, const Measurements& without) const {
  VecX s(J_.rows());
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < without.acc.cols(); ++i) {
    for (int a = 0; a < 3; ++a)
      if (std::isfinite(without.acc(a, i)))
        s[row++] = (with.acc(a, i) - without.acc(a, i)) / readout_.accelerometer_noise;
    for (int a = 0; a < 3; ++a)
      if (std::isfinite(without.gimbal(a, i)))
        s[row++] =
            angle_difference(with.gimbal(a, i), without.gimbal(a, i)) / readout_.gimbal_noise;
  }
  return s;
}

double Absorption::left_product(const VecX& a, const VecX& b) const {
  const auto lower = L_.triangularView<Eigen::Lower>();
  const VecX ta = lower.solve(J_.transpose() * a), tb = lower.solve(J_.transpose() * b);
  return a.dot(b) - ta.dot(tb);
}

MatX Absorption::left_products(const MatX& signals) const {
  const MatX taken = L_.triangularView<Eigen::Lower>().solve(J_.transpose() * signals);
  return signals.transpose() * signals - taken.transpose() * taken;
}

Absorption::Size Absorption::size_of(const VecX& signal) const {
  const double raw = signal.squaredNorm(), left = std::max(0.0, left_product(signal, signal));
  return {std::sqrt(left), raw > 0.0 ? 1.0 - left / raw : 1.0};
}

double Absorption::cosine(const VecX& a, const VecX& b) const {
  return left_product(a, b) / std::sqrt(left_product(a, a) * left_product(b, b));
}

}  // namespace drift::blind
