#include "core/stats/trend.hpp"

#include <Eigen/QR>
#include <cmath>
#include <set>
#include <utility>

#include "core/stats/median.hpp"
#include "core/stats/normal.hpp"

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

namespace {

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

Detrended without_trend_and_isolated(std::vector<Stretch> stretches, int degree, double by_chance) {
  Detrended out;
  std::size_t samples = 0;
  for (const Stretch& s : stretches) {
    out.stretches.push_back(without_trend(s, degree));
    samples += s.size();
  }
  if (samples == 0) return out;
  const double far = -normal_quantile(0.5 * by_chance / static_cast<double>(samples));
  std::set<std::pair<std::size_t, std::size_t>> isolated;
  // A wild sample bends its polynomial: it is on it after a few turns.
  for (std::size_t turn = 0; turn < samples && isolated.size() < samples / 10; ++turn) {
    std::size_t in = 0, at = 0;
    double farthest = 0.0;
    for (std::size_t i = 0; i < stretches.size(); ++i)
      for (std::size_t k = 0; k < stretches[i].size(); ++k)
        if (const double distance = std::abs(out.stretches[i][k]); distance > farthest)
          farthest = distance, in = i, at = k;
    const double usual = usual_distance(out.stretches);
    if (!(usual > 0.0) || farthest <= far * usual) break;
    isolated.emplace(in, at);
    stretches[in][at] -= out.stretches[in][at];
    out.stretches[in] = without_trend(stretches[in], degree);
  }
  out.isolated = isolated.size();
  return out;
}

}  // namespace drift::stats
