#include "analysis/diagnosis/profile_interval.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "analysis/inference/thresholds.hpp"
#include "core/stats/normal.hpp"

namespace drift::diagnosis {
namespace {

using Points = std::vector<Profile::Point>;

/// Vertex of the parabola through a least point and its neighbours; nothing at an end and where
/// there is none between them.
std::optional<Profile::Point> parabola_at(const Points& points, std::size_t k) {
  const Profile::Point& least = points[k];
  if (k == 0 || k + 1 == points.size()) return std::nullopt;
  const double a = points[k - 1].value - least.value, b = points[k + 1].value - least.value;
  const double fa = points[k - 1].loss - least.loss, fb = points[k + 1].loss - least.loss;
  const double square = (fb / b - fa / a) / (b - a), slope = fa / a - square * a;
  if (!(square > 0.0)) return std::nullopt;
  const double at = -0.5 * slope / square;
  return Profile::Point{least.value + at, least.loss + 0.5 * slope * at};
}

/// That vertex, or the point itself where the vertex would be deeper than the point by as much as
/// ends an interval of 95 %: then the best fit there is would lie outside its own interval, and the
/// points are too far apart for a parabola.
Profile::Point vertex_at(const Points& points, std::size_t k) {
  const Profile::Point& least = points[k];
  const auto vertex = parabola_at(points, k);
  const bool believed = vertex && least.loss - vertex->loss < std::pow(stats::half_width_95, 2);
  return believed ? *vertex : least;
}

/// A minimum of the loss and where it has grown to that of 95 % on either side; NaN beyond the
/// points.
struct Valley {
  std::size_t least = 0;  ///< point
  Profile::Point top;
  double low = 0.0, high = 0.0;
};

Valley valley_at(const Points& points, std::size_t k, const Profile::Point& top) {
  Valley out{k, top};
  const auto crossing = [&](double side) {
    double x = out.top.value, root = 0.0;
    const auto beyond = [&](std::size_t n) { return side * (points[n].value - x) > 0.0; };
    for (std::size_t n = k; n<points.size(); side> 0.0 ? ++n : --n) {
      if (!beyond(n)) continue;
      const double next = std::sqrt(std::max(0.0, points[n].loss - out.top.loss));
      if (next >= stats::half_width_95)
        return x + (points[n].value - x) * (stats::half_width_95 - root) / (next - root);
      x = points[n].value;
      root = next;
    }
    return std::nan("");
  };
  out.low = crossing(-1.0);
  out.high = crossing(1.0);
  return out;
}

/// The minima, the deepest first, without those that lie in the interval of a deeper one. Beside
/// the deepest one points lie as the profile has them, and a parabola through them may run
/// anywhere.
std::vector<Valley> valleys_of(const Points& points) {
  std::vector<std::size_t> minima;
  for (std::size_t k = 0; k < points.size(); ++k)
    if ((k == 0 || points[k].loss <= points[k - 1].loss) &&
        (k + 1 == points.size() || points[k].loss < points[k + 1].loss))
      minima.push_back(k);
  std::ranges::stable_sort(minima, {}, [&](std::size_t k) { return points[k].loss; });
  std::vector<Valley> valleys;
  for (const std::size_t k : minima)
    if (std::ranges::none_of(valleys, [&](const Valley& v) {
          return !(points[k].value < v.low) && !(points[k].value > v.high);
        }))
      valleys.push_back(valley_at(points, k, valleys.empty() ? vertex_at(points, k) : points[k]));
  return valleys;
}

/// What a valley has of the posterior, to a factor that is the same for all.
double mass_of(const Valley& v, const Points& points) {
  const double low = std::isfinite(v.low) ? v.low : points.front().value;
  const double high = std::isfinite(v.high) ? v.high : points.back().value;
  return std::exp(-0.5 * v.top.loss) * (high - low);
}

/// The most that it could have, whatever lies between its least point and the next ones.
double most_mass_of(const Valley& v, const Points& points) {
  const std::size_t before = v.least > 0 ? v.least - 1 : 0,
                    behind = std::min(v.least + 1, points.size() - 1);
  return std::exp(-0.5 * v.top.loss) * (points[behind].value - points[before].value);
}

void want_in_valley(const Valley& v, const Points& points, std::vector<double>& wanted) {
  const Profile::Point& least = points[v.least];
  const auto halve = [&](const Profile::Point& beside) {
    if (beside.loss - least.loss > std::pow(stats::half_width_95, 2))
      wanted.push_back(0.5 * (least.value + beside.value));
  };
  // A top that nobody has fitted, a sigma below what was.
  if (const auto vertex = parabola_at(points, v.least); vertex && least.loss - vertex->loss > 1.0)
    wanted.push_back(vertex->value);
  if (v.least > 0) halve(points[v.least - 1]);
  if (v.least + 1 < points.size()) halve(points[v.least + 1]);
  // Points of a parabola at 1.5 and 3 sigma are 1.5 apart in the root of the loss.
  constexpr double long_way = 2.0;
  const auto root = [&](const Profile::Point& p) {
    return std::sqrt(std::max(0.0, p.loss - v.top.loss));
  };
  for (const double end : {v.low, v.high}) {
    const auto behind = std::ranges::upper_bound(points, end, {}, &Profile::Point::value);
    if (!std::isfinite(end) || behind == points.begin() || behind == points.end()) continue;
    const bool apart = end > (behind - 1)->value && end < behind->value;
    if (apart && std::abs(root(*behind) - root(*(behind - 1))) > long_way) wanted.push_back(end);
  }
}

}  // namespace

Profile with_interval(Profile profile) {
  Points& points = profile.points;
  std::ranges::sort(points, {}, &Profile::Point::value);
  std::vector<Valley> valleys = valleys_of(points);
  const Profile::Point top = valleys.front().top;
  profile.top = top.value;
  for (Profile::Point& p : points) p.loss = std::max(0.0, p.loss - top.loss);
  for (Valley& v : valleys) v.top.loss -= top.loss;
  const auto mass = [&](const Valley& v) { return mass_of(v, points); };
  double all = 0.0, held = 0.0;
  for (const Valley& v : valleys) all += mass(v);
  std::ranges::stable_sort(valleys, std::greater{}, mass);
  profile.low_95 = std::numeric_limits<double>::infinity();
  profile.high_95 = -profile.low_95;
  for (const Valley& v : valleys) {
    if (held >= inference::SearchLimits::credible * all) break;
    held += mass(v);
    // Of an end that was not found nothing is known.
    profile.low_95 = v.low < profile.low_95 || std::isnan(v.low) ? v.low : profile.low_95;
    profile.high_95 = v.high > profile.high_95 || std::isnan(v.high) ? v.high : profile.high_95;
  }
  return profile;
}

std::vector<double> wanted_points(const Profile& profile, double outward) {
  const Points& points = profile.points;
  std::vector<double> wanted;
  if (!std::isfinite(profile.low_95)) wanted.push_back(points.front().value - outward);
  if (!std::isfinite(profile.high_95)) wanted.push_back(points.back().value + outward);
  const std::vector<Valley> valleys = valleys_of(points);
  double most = 0.0;
  for (const Valley& v : valleys) most = std::max(most, mass_of(v, points));
  for (const Valley& v : valleys)
    if (&v == &valleys.front() ||
        most_mass_of(v, points) > (1.0 - inference::SearchLimits::credible) * most)
      want_in_valley(v, points, wanted);
  return wanted;
}

}  // namespace drift::diagnosis
