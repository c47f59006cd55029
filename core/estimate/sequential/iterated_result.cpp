#include <utility>

#include "core/estimate/sequential/iterated_passes.hpp"

namespace drift {

/// What is reported of the last pass.
void IteratedPasses::finish() {
  measure_lag();
  information_.invert(P_);
  const AttitudeFilter& end = ends_.back();
  for (std::size_t k = 0; k < end.walking().size(); ++k) {
    // The value at the end: what it was at the beginning, and what the walk has added.
    const auto i = static_cast<Eigen::Index>(end.walking()[k]);
    x_[i] += end.walked(k, moved_);
  }
  if (!end.walking().empty()) {
    const auto m = static_cast<Eigen::Index>(end.walking().size());
    MatX J = MatX::Identity(P_.rows(), P_.cols());
    for (Eigen::Index k = 0; k < m; ++k)
      J.row(static_cast<Eigen::Index>(end.walking()[static_cast<std::size_t>(k)])) +=
          end.walked_by(static_cast<std::size_t>(k));
    P_ = J * P_ * J.transpose();
    for (Eigen::Index k = 0; k < m; ++k)
      for (Eigen::Index l = 0; l < m; ++l)
        P_(static_cast<Eigen::Index>(end.walking()[static_cast<std::size_t>(k)]),
           static_cast<Eigen::Index>(end.walking()[static_cast<std::size_t>(l)])) +=
            end.variance()(3 + k, 3 + l);
  }
  theta_ = rows_.layout().theta_at(x_);
}

/// Whitened by the filter of the attitude, residuals at the estimate of neighbours u, t have the
/// covariance -u (1 + information)^-1 t^T where innovations are white.
void IteratedPasses::measure_lag() {
  const std::size_t right = rows_.attitude().right();
  information_.whiten(row(0), 3 * triples_);
  const VecX& d = information_.whitened(moved_);
  double lagged = 0.0;
  std::size_t pairs = 0;
  const double* last[2] = {nullptr, nullptr};
  for (std::size_t k = 0; k < triples_; ++k) {
    const double* now = row(3 * k);
    const auto [channel, follows] = neighbours_[k];
    const double* before = std::exchange(last[channel], now);
    for (std::size_t a = 0; follows && a < 3; ++a) {
      const double *s = before + a * rows_.width(), *t = now + a * rows_.width();
      if (s[right] == 0.0 || t[right] == 0.0) continue;
      const Eigen::Map<const VecX> u(s, d.size()), v(t, d.size());
      lagged += (s[right] - u.dot(d)) * (t[right] - v.dot(d)) + u.dot(v);
      ++pairs;
    }
  }
  if (stretch_lag_) stretch_lag_->add(ends_, moved_, information_, lagged, pairs);
  const double variance = nis_ / static_cast<double>(scalars_);
  lag1_ = pairs > 0 && nis_ > 0.0 ? lagged / static_cast<double>(pairs) / variance : 0.0;
}

}  // namespace drift
