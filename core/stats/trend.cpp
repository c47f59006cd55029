#include "core/stats/trend.hpp"

#include <Eigen/QR>

namespace drift::stats {

Stretch without_trend(const Stretch& stretch, int degree) {
  const auto n = static_cast<Eigen::Index>(stretch.size());
  if (n <= degree + 1) return Stretch(stretch.size(), 0.0);
  Eigen::MatrixXd powers(n, degree + 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double x = 2.0 * static_cast<double>(k) / static_cast<double>(n - 1) - 1.0;
    double power = 1.0;
    for (Eigen::Index p = 0; p <= degree; ++p, power *= x) powers(k, p) = power;
  }
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(stretch.data(), n);
  const Eigen::VectorXd rest = y - powers * powers.householderQr().solve(y);
  return {rest.begin(), rest.end()};
}

}  // namespace drift::stats
