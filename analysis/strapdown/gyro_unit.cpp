#include "analysis/strapdown/gyro_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "analysis/preparation/input_thresholds.hpp"
#include "analysis/strapdown/gyro_signs.hpp"
#include "core/base/check.hpp"
#include "core/stats/median.hpp"

namespace drift::strapdown {
namespace {

using Limits = preparation::GyroUnitLimits;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// How the columns are taken to be instead of as they are declared.
struct Taken {
  double times = 1.0;  ///< the rates
  Mixup gyros = {}, accelerometers = {};
};

/// Errors of all ways whose turn is known, against the turn.
std::vector<double> errors(const Signals& s, const std::vector<Dwell>& dwells, const Taken& as) {
  std::vector<double> all;
  for (std::size_t d = 1; d < dwells.size(); ++d) {
    const Dwell &from = dwells[d - 1], &to = dwells[d];
    const double turn = angle_between(from.acc, to.acc);
    if (turn < Limits::least_turn) continue;
    Mat3 R = Mat3::Identity();
    for (std::size_t k = from.last + 1; k <= to.first; ++k) {
      const Vec3 rate = as.gyros.of(mean_between(s, s.gyro, k) - from.gyro);
      R = R * rotation(Vec3((s.time[k] - s.time[k - 1]) * as.times * rate));
    }
    if (!R.allFinite()) continue;  // a sample is missing
    const Vec3 before = as.accelerometers.of(from.acc), after = as.accelerometers.of(to.acc);
    all.push_back(angle_between(R.transpose() * before, after) / turn);
  }
  return all;
}

struct Mistake {
  const char* words;
  double times;  ///< the rates; or the times, which does the same to turns
};

/// Gyros or accelerometers exchanged or reversed.
void require_columns(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site,
                     const std::string& source, const std::vector<double>& declared) {
  const std::string mends = mistaken_columns(dwells, site, declared, [&](const ColumnsAs& as) {
    return errors(signals, dwells, {.gyros = as.gyros, .accelerometers = as.accelerometers});
  });
  if (mends.empty()) return;
  const auto wrong =
      std::ranges::count_if(declared, [](double error) { return error > Limits::nothing_like; });
  throw InputError(
      ExitCode::recording,
      fmt::format("{}: in {} of {} turns the gyros turn gravity by nothing like what the "
                  "accelerometers see from rest to rest. {}",
                  source, wrong, declared.size(), mends));
}

}  // namespace

void require_gyro_unit(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site,
                       const std::string& source) {
  const std::vector<double> declared = errors(signals, dwells, {});
  if (declared.size() < Limits::fewest_turns) return;
  const double as_declared = stats::upper_median(declared);
  if (as_declared < Limits::alike) return require_columns(signals, dwells, site, source, declared);
  constexpr double deg = detail::deg;
  constexpr Mistake mistakes[] = {
      {"their unit: the numbers look like [rad/s], not [deg/s]", 1.0 / deg},
      {"their unit: the numbers look like [deg/s], not [rad/s]", deg},
      {"their unit: the numbers look like [deg/s], not [deg/h]", 3600.0},
      {"their unit: the numbers look like [rad/s], not [deg/h]", 3600.0 / deg},
      {"their unit: the numbers look like [deg/h], not [deg/s]", 1.0 / 3600.0},
      {"their unit: the numbers look like [deg/h], not [rad/s]", deg / 3600.0},
      {"the unit of the times: they look like [ms], not [s]. Write time [ms] in the header; or "
       "that "
       "of the gyros, whose numbers look like mdeg/s, not deg/s",
       1e-3},
      {"the unit of the times: they look like [us], not [s]. Write time [us] in the header", 1e-6},
      {"the unit of the times: they look like [s], not [ms]. Write time [s] in the header; or that "
       "of the gyros, whose numbers look like deg/s, not mdeg/s",
       1e3}};
  for (const Mistake& m : mistakes) {
    const double otherwise = stats::upper_median(errors(signals, dwells, {m.times}));
    if (otherwise > std::min(Limits::alike, Limits::far_better * as_declared)) continue;
    throw InputError(
        ExitCode::recording,
        fmt::format("{}:{}: the gyros turn gravity from rest to rest by nothing like what the "
                    "accelerometers see: the error is {:.0f} % of the turn, the median of {} "
                    "(expected a few per cent, and it is {:.1f} % after this). Correct {}",
                    source, std::string_view(m.words).starts_with("their") ? "gyro_x" : "time",
                    100.0 * as_declared, declared.size(), 100.0 * otherwise, m.words));
  }
  require_columns(signals, dwells, site, source, declared);
}

}  // namespace drift::strapdown
