#include "core/estimate/strapdown/gyrocompass.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/decompose.hpp"

namespace drift::strapdown {

Gyrocompass gyrocompass(const CaseTest& test, const std::vector<double>& assumed_azimuth,
                        double sigma_drift) {
  const Timeline& timeline = test.timeline;
  const Vec3 omega_ie_l = timeline.site.omega_ie_l();
  const double horizontal = omega_ie_l.head<2>().norm();
  const auto chains = static_cast<Eigen::Index>(timeline.chains);
  const Eigen::Index n = 2 * chains + 3;
  MatX N = MatX::Zero(n, n);
  VecX right = VecX::Zero(n);
  N.diagonal().tail<3>().setConstant(1.0 / (sigma_drift * sigma_drift));
  const double weight = 1.0 / (test.readout.gimbal_noise * test.readout.gimbal_noise);
  for (const Interval& i : timeline.intervals) {
    if (!i.rest) continue;
    const Mat3 R_pl = timeline.nodes[i.middle_node()].R_lr.transpose();
    MatX J = MatX::Zero(3, n);
    J.middleCols<2>(2 * i.chain) = R_pl.leftCols<2>();
    J.rightCols<3>().setIdentity();
    const Vec3 seen = i.omega_cmd_p - R_pl.col(2) * omega_ie_l[2];
    N += weight * J.transpose() * J;
    right += weight * J.transpose() * seen;
  }
  const Cholesky llt(N);
  const VecX x = llt.solve(right);
  const MatX P = llt.solve(MatX(MatX::Identity(n, n)));
  Gyrocompass out;
  out.sees_earth = horizontal > 0.0;
  out.sigma = 0.0;
  for (Eigen::Index c = 0; c < chains; ++c) {
    const Eigen::Vector2d north = x.segment<2>(2 * c);
    const double sigma = std::sqrt(P.block<2, 2>(2 * c, 2 * c).trace() / 2.0);
    // North as the gyros have it, against the North that was assumed.
    const double assumed =
        static_cast<std::size_t>(c) < assumed_azimuth.size() ? assumed_azimuth[c] : 0.0;
    out.azimuth.push_back(assumed - std::atan2(north[1], north[0]));
    out.sigma = std::max(out.sigma, sigma / horizontal);
    if (std::abs(north.norm() - horizontal) > 3.0 * sigma + 0.1 * horizontal)
      out.sees_earth = false;
  }
  if (out.sigma > 0.3) out.sees_earth = false;
  if (!out.sees_earth) out.sigma = 1.0;
  return out;
}

}  // namespace drift::strapdown
