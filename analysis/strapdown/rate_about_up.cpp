#include "analysis/strapdown/rate_about_up.hpp"

#include <cmath>

#include "core/base/decompose.hpp"

namespace drift::strapdown {

std::optional<RateAboutUp> rate_about_up(const std::vector<Vec3>& up,
                                         const std::vector<Vec3>& gyro) {
  constexpr Eigen::Index unknowns = 4, rate = 3;
  const auto n = static_cast<Eigen::Index>(up.size());
  if (n <= unknowns) return std::nullopt;
  MatX rows(n, unknowns);
  VecX read(n);
  for (Eigen::Index d = 0; d < n; ++d) {
    const Vec3& u = up[static_cast<std::size_t>(d)];
    rows.row(d) << u.transpose(), 1.0;
    read[d] = u.dot(gyro[static_cast<std::size_t>(d)]);
  }
  const MatX normal = rows.transpose() * rows;
  const VecX fit = solve_symmetric(normal, VecX(rows.transpose() * read));
  const VecX of_rate = solve_symmetric(normal, VecX(VecX::Unit(unknowns, rate)));
  // A pivot that vanishes is left out: where attitudes leave the rate to the drifts that solves
  // nothing.
  const bool solved = (normal * of_rate - VecX::Unit(unknowns, rate)).norm() < 1e-6;
  const double variance = (read - rows * fit).squaredNorm() / static_cast<double>(n - unknowns);
  const RateAboutUp found{fit[rate], std::sqrt(variance * of_rate[rate])};
  const bool told = solved && of_rate[rate] > 0.0 && of_rate[rate] <= 1.0;
  if (!told || !std::isfinite(found.rate) || !std::isfinite(found.sigma)) return std::nullopt;
  return found;
}

}  // namespace drift::strapdown
