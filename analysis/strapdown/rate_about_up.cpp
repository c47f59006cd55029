#include "analysis/strapdown/rate_about_up.hpp"

#include <cmath>

#include "core/base/decompose.hpp"

namespace drift::strapdown {

std::optional<RateAboutUp> rate_about_up(const std::vector<Vec3>& up,
                                         const std::vector<Vec3>& gyro) {
  constexpr Eigen::Index unknowns = 4;
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
  const double of_one = solve_symmetric(normal, VecX(VecX::Unit(unknowns, 3)))[3];
  const double variance = (read - rows * fit).squaredNorm() / static_cast<double>(n - unknowns);
  const RateAboutUp found{fit[3], std::sqrt(variance * of_one)};
  if (!(of_one > 0.0 && of_one <= 1.0) || !std::isfinite(found.rate) || !std::isfinite(found.sigma))
    return std::nullopt;
  return found;
}

}  // namespace drift::strapdown
