#include "core/estimate/strapdown/unknown_north.hpp"

#include <algorithm>
#include <map>

namespace drift::strapdown {
namespace {

/// The way to a dwell.
struct Way {
  double length = 0.0;  ///< [s]
  Mat3 turn = Mat3::Identity();
};

std::map<int, Way> ways_of(const Timeline& timeline, const Vec3& drift) {
  std::map<int, Way> ways;
  for (const Interval& i : timeline.intervals)
    if (i.slew) {
      Way& way = ways[i.position];
      way.length += i.length();
      way.turn = way.turn * rotation(Vec3(i.length() * (i.omega_cmd_p - drift)));
    }
  return ways;
}

/// How alike a vector that is fixed to the Earth is, in axes of the case, in a dwell and in the
/// next, on average: a third of the trace of the turn between them.
double likeness_of_neighbours(const std::map<int, Way>& ways) {
  if (ways.empty()) return 0.0;
  constexpr double most = 0.9;  // of a unit that hardly turns no mean is known at all
  double sum = 0.0;
  for (const auto& [dwell, way] : ways) sum += way.turn.trace() / 3.0;
  return std::clamp(sum / static_cast<double>(ways.size()), 0.0, most);
}

}  // namespace

UnknownNorth unknown_north(const Timeline& timeline, const Vec3& drift) {
  const std::map<int, Way> ways = ways_of(timeline, drift);
  const double north = timeline.site.north_rate(), alike = likeness_of_neighbours(ways);
  UnknownNorth out{2.0 / 3.0 * north * north * (1.0 + alike) / (1.0 - alike)};
  double squares = 0.0, sum = 0.0;
  for (const auto& [dwell, way] : ways) {
    squares += way.length * way.length;
    sum += way.length;
  }
  out.walk = sum > 0.0 ? out.variance * squares / sum : 0.0;
  return out;
}

}  // namespace drift::strapdown
