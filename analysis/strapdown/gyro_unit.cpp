#include "analysis/strapdown/gyro_unit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/base/check.hpp"
#include "core/stats/median.hpp"

namespace drift::strapdown {
namespace {

using Limits = preparation::GyroUnitLimits;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Errors of all ways whose turn is known, against the turn; rates `times` as they are declared.
std::vector<double> errors(const Signals& s, const std::vector<Dwell>& dwells, double times) {
  std::vector<double> all;
  for (std::size_t d = 1; d < dwells.size(); ++d) {
    const Dwell &from = dwells[d - 1], &to = dwells[d];
    const double turn = angle_between(from.acc, to.acc);
    if (turn < Limits::least_turn) continue;
    Mat3 R = Mat3::Identity();
    for (std::size_t k = from.last + 1; k <= to.first; ++k) {
      const Vec3 rate = 0.5 * (s.gyro[k - 1] + s.gyro[k]) - from.gyro;
      R = R * rotation(Vec3((s.time[k] - s.time[k - 1]) * times * rate));
    }
    if (!R.allFinite()) continue;  // a sample is missing
    all.push_back(angle_between(R.transpose() * from.acc, to.acc) / turn);
  }
  return all;
}

struct Mistake {
  const char* words;
  double times;
};

}  // namespace

void require_gyro_unit(const Signals& signals, const std::vector<Dwell>& dwells,
                       const std::string& source) {
  const std::vector<double> declared = errors(signals, dwells, 1.0);
  if (declared.size() < Limits::fewest_turns) return;
  const double as_declared = stats::upper_median(declared);
  if (as_declared < Limits::nothing_like) return;
  constexpr double deg = detail::deg;
  constexpr Mistake mistakes[] = {
      {"unit: the numbers look like [rad/s], not [deg/s]", 1.0 / deg},
      {"unit: the numbers look like [deg/s], not [rad/s]", deg},
      {"unit: the numbers look like [deg/s], not [deg/h]", 3600.0},
      {"unit: the numbers look like [rad/s], not [deg/h]", 3600.0 / deg},
      {"unit: the numbers look like [deg/h], not [deg/s]", 1.0 / 3600.0},
      {"unit: the numbers look like [deg/h], not [rad/s]", deg / 3600.0},
      {"sign: put a - before the columns in [recording]", -1.0}};
  for (const Mistake& m : mistakes) {
    const double otherwise = stats::upper_median(errors(signals, dwells, m.times));
    if (otherwise > Limits::alike) continue;
    throw InputError(
        ExitCode::recording,
        fmt::format("{}:gyro_x: the gyros turn gravity from rest to rest by nothing like what the "
                    "accelerometers see: the error is {:.0f} % of the turn, the median of {} "
                    "(expected a few per cent, and it is {:.1f} % after this). Correct their {}",
                    source, 100.0 * as_declared, declared.size(), 100.0 * otherwise, m.words));
  }
}

}  // namespace drift::strapdown
