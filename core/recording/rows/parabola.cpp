#include "core/recording/rows/parabola.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/base/check.hpp"
#include "core/base/linalg.hpp"

namespace drift {

std::optional<ParabolaValue> parabola_at(const std::vector<double>& times,
                                         const std::vector<double>& values, double t, double half,
                                         std::size_t fewest) {
  DRIFT_EXPECTS(times.size() == values.size() && half > 0.0 && fewest > 3);
  const auto first = std::ranges::lower_bound(times, t - half) - times.begin(),
             end = std::ranges::upper_bound(times, t + half) - times.begin();
  if (end - first < static_cast<std::ptrdiff_t>(fewest)) return std::nullopt;
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (std::ptrdiff_t k = first; k < end; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const double s = (times[row] - t) / half;
    const Vec3 powers(1.0, s, s * s);
    normal += powers * powers.transpose();
    right += powers * values[row];
  }
  const Eigen::LDLT<Mat3> solver = normal.ldlt();
  return ParabolaValue{solver.solve(right)[0], solver.solve(Vec3::UnitX())[0]};
}

}  // namespace drift
