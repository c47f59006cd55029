#include "core/estimate/sequential/stretch_lag.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace drift {

StretchLag::StretchLag(const CompressedTest& test, const Layout& layout, std::size_t width)
    : test_(test),
      rate_(static_cast<Eigen::Index>(layout.num_rate)),
      states_(static_cast<Eigen::Index>(layout.size())),
      kept_(test.timeline().intervals.size()),
      N_(3, rate_),
      work_(3, rate_),
      by_parameters_(0, static_cast<Eigen::Index>(width)) {}

void StretchLag::keep(std::size_t i, const StretchRows& rows,
                      const IntervalSensitivity& sensitivity) {
  const std::size_t last = test_.timeline().intervals[i].node_count() - 1;
  Kept& kept = kept_[i];
  kept.Phi = sensitivity.Phi[last];
  kept.G = sensitivity.G[last];
  const StretchReadings* stretch = test_.readings(i);
  if (!stretch) return;
  if (stretch->accelerometers.rows() > 0) kept.accelerometers = rows.of_accelerometers();
  if (stretch->gimbals.rows() > 0) kept.gimbals = rows.of_gimbals();
}

void StretchLag::add(const std::vector<AttitudeFilter>& ends, const VecX& moved,
                     const Information& information, double& lagged, std::size_t& pairs) {
  const auto& intervals = test_.timeline().intervals;
  for (std::size_t i = intervals.size(); i-- > 0;) {
    if (i + 1 == intervals.size() || intervals[i + 1].cage) {
      M_.setIdentity();
      N_.setZero();
    }
    const Mat3 back = kept_[i].Phi.inverse();
    M_ = (back * M_).eval();
    work_ = N_ - kept_[i].G.leftCols(rate_);
    N_.noalias() = back * work_;
    const StretchReadings* stretch = test_.readings(i);
    if (!stretch) continue;
    const AttitudeFilter& end = ends[static_cast<std::size_t>(intervals[i].chain)];
    if (stretch->accelerometers.rows() > 0)
      add_channel(stretch->accelerometers, kept_[i].accelerometers, end, moved, information, lagged,
                  pairs);
    if (stretch->gimbals.rows() > 0)
      add_channel(stretch->gimbals, kept_[i].gimbals, end, moved, information, lagged, pairs);
  }
}

void StretchLag::add_channel(const StretchChannel& channel, const StretchRows::Rows& rows,
                             const AttitudeFilter& end, const VecX& moved,
                             const Information& information, double& lagged, std::size_t& pairs) {
  const Eigen::Index n = states_, count = rows.rows();
  // The attitude at the end is estimated at a + U x, with a variance that x does not lessen.
  by_end_.noalias() = rows.leftCols<3>() * M_;
  by_parameters_.setZero(count, by_parameters_.cols());
  auto by_x = by_parameters_.leftCols(n);
  by_x = rows.middleCols(3, n);
  by_x.leftCols(rate_).noalias() += rows.leftCols<3>() * N_;
  residual_ = rows.col(3 + n);
  residual_.noalias() -= by_x * moved;
  residual_.noalias() -= by_end_ * end.attitude(moved);
  for (Eigen::Index k = 0; k < 3; ++k)
    by_x.noalias() += by_end_.col(k) * end.attitude_by(static_cast<std::size_t>(k)).transpose();
  information.whiten(by_parameters_.data(), static_cast<std::size_t>(count));
  const Mat3 V = end.variance().topLeftCorner<3, 3>();
  by_rest_.noalias() = by_end_ * V.llt().matrixL().toDenseMatrix();
  Eigen::Index first = 0;
  for (const StretchChannel::Axis& axis : channel.axes) {
    const Eigen::Index m = axis.rows();
    if (m == 0) continue;
    const auto by_x_here = by_parameters_.middleRows(first, m).leftCols(n);
    products_.noalias() = by_x_here * by_x_here.transpose();
    products_.noalias() +=
        by_rest_.middleRows(first, m) * by_rest_.middleRows(first, m).transpose();
    lagged += axis.how->neighbours.cwiseProduct(products_).sum();
    of_samples_ = axis.left;
    of_samples_.noalias() += axis.how->projection.basis * residual_.segment(first, m);
    const std::vector<std::size_t>& samples = axis.how->samples;
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
      if (samples[k] + 1 != samples[k + 1]) continue;
      const auto at = static_cast<Eigen::Index>(k);
      lagged += of_samples_[at] * of_samples_[at + 1];
      ++pairs;
    }
    first += m;
  }
}

}  // namespace drift
