#include <algorithm>
#include <cmath>

#include "core/estimate/sequential/iterated_passes.hpp"

namespace drift {

/// What is reported of the last pass.
void IteratedPasses::finish() {
  information_.invert(P_);
  measure_lag();
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
  theta_ = layout().theta_at(x_);
  for (Eigen::Index k = 0; k < sigma_.size(); ++k)
    sigma_[k] = layout().sigma[k] * std::sqrt(P_(k, k));
}

/// Whitened by the filter of the attitude, residuals at the estimate of neighbours s, t have the
/// covariance -s P t^T where innovations are white.
void IteratedPasses::measure_lag() {
  const std::size_t right = rows_.attitude().right(), width = rows_.width();
  for (std::size_t k = 0; k < 3 * triples_; ++k) {
    const double* t = row(k);
    residual_[k] =
        t[right] == 0.0 ? 0.0 : t[right] - moved_.dot(Eigen::Map<const VecX>(t, moved_.size()));
  }
  const std::size_t none = neighbours_.size();
  std::size_t last[2] = {none, none};
  double lagged = 0.0;
  std::size_t pairs = 0;
  for (std::size_t k = 0; k < triples_; ++k) {
    Neighbour& now = neighbours_[k];
    now.before = now.follows ? last[now.channel] : none;
    now.after = none;
    last[now.channel] = k;
    // Of three in a row the one in the middle stands for two pairs, s P t^T + t P u^T.
    now.in_the_middle = now.before != none && !neighbours_[now.before].in_the_middle;
    if (now.before == none) continue;
    neighbours_[now.before].after = k;
    for (std::size_t a = 0; a < 3; ++a) {
      const double s = residual_[3 * now.before + a], t = residual_[3 * k + a];
      if (s == 0.0 || t == 0.0) continue;  // not measured: its row is zero, too
      lagged += s * t;
      ++pairs;
    }
  }
  std::size_t held = 0;
  const auto add_held = [&] {
    lagged += information_.product(middle_.data(), beside_.data(), held, P_);
    held = 0;
  };
  for (std::size_t k = 0; k < triples_; ++k) {
    const Neighbour& now = neighbours_[k];
    if (!now.in_the_middle) continue;
    const double *before = row(3 * now.before),
                 *after = now.after == none ? nullptr : row(3 * now.after);
    std::copy_n(row(3 * k), 3 * width, &middle_[held * width]);
    double* sum = &beside_[held * width];
    for (std::size_t c = 0; c < 3 * width; ++c) sum[c] = after ? before[c] + after[c] : before[c];
    held += 3;
    if (held == held_at_most) add_held();
  }
  add_held();
  const double variance = nis_ / static_cast<double>(scalars_);
  lag1_ = pairs > 0 && nis_ > 0.0 ? lagged / static_cast<double>(pairs) / variance : 0.0;
}

}  // namespace drift
