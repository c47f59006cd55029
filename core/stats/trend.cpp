#include "core/stats/trend.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/check.hpp"
#include "core/stats/median.hpp"
#include "core/stats/normal.hpp"

namespace drift::stats {

Stretch without_trend(const Stretch& stretch, const std::vector<double>& time, int degree) {
  DRIFT_EXPECTS(time.size() == stretch.size());
  const auto n = static_cast<Eigen::Index>(stretch.size());
  if (n <= degree + 1) return Stretch(stretch.size(), 0.0);
  Eigen::MatrixXd powers(n, degree + 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double x =
        2.0 * (time[static_cast<std::size_t>(k)] - time.front()) / (time.back() - time.front()) -
        1.0;
    double power = 1.0;
    for (Eigen::Index p = 0; p <= degree; ++p, power *= x) powers(k, p) = power;
  }
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(stretch.data(), n);
  const Eigen::VectorXd rest = y - powers * powers.householderQr().solve(y);
  return {rest.begin(), rest.end()};
}

namespace {

/// Of the farthest sample of a stretch: what is nearer may be where it is by the bent polynomial.
constexpr double as_far = 0.9;

/// Half of Gaussian noise is nearer than this, in its sigma.
const double median_distance = normal_quantile(0.75);

/// Sigma of Gaussian noise of which the rests have the median distance.
double usual_distance(const std::vector<Stretch>& rests) {
  std::vector<double> distances;
  for (const Stretch& s : rests)
    for (const double x : s) distances.push_back(std::abs(x));
  return distances.empty() ? 0.0 : median(std::move(distances)) / median_distance;
}

}  // namespace

Detrended without_trend_and_isolated(std::vector<Stretch> stretches,
                                     const std::vector<std::vector<double>>& times, int degree,
                                     double by_chance) {
  DRIFT_EXPECTS(times.size() == stretches.size());
  Detrended out;
  std::size_t samples = 0;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    out.stretches.push_back(without_trend(stretches[i], times[i], degree));
    samples += stretches[i].size();
  }
  if (samples == 0) return out;
  const double far = -normal_quantile(0.5 * by_chance / static_cast<double>(samples));
  std::set<std::pair<std::size_t, std::size_t>> isolated;
  // A wild sample bends its polynomial: it is on it after a few turns, and others are looked at
  // then.
  for (bool any = true; any && isolated.size() < samples / 10;) {
    any = false;
    const double near = far * usual_distance(out.stretches);
    if (!(near > 0.0)) break;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      Stretch &stretch = stretches[i], &rest = out.stretches[i];
      double farthest = 0.0;
      for (const double x : rest) farthest = std::max(farthest, std::abs(x));
      if (farthest <= near) continue;
      for (std::size_t k = 0; k < rest.size(); ++k)
        if (std::abs(rest[k]) > std::max(near, as_far * farthest)) {
          isolated.emplace(i, k);
          stretch[k] -= rest[k];
        }
      rest = without_trend(stretch, times[i], degree);
      any = true;
    }
  }
  out.isolated = isolated.size();
  return out;
}

Detrended without_trend_and_isolated(std::vector<Stretch> stretches, int degree, double by_chance) {
  std::vector<std::vector<double>> times;
  for (const Stretch& s : stretches) {
    times.emplace_back(s.size());
    std::iota(times.back().begin(), times.back().end(), 0.0);
  }
  return without_trend_and_isolated(std::move(stretches), times, degree, by_chance);
}

}  // namespace drift::stats
