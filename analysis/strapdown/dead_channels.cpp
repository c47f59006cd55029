#include "analysis/strapdown/dead_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/base/words.hpp"

namespace drift::strapdown {
namespace {

/// The longest stretch in which an axis of a sensor is measured without a break [s].
double longest_measured(const Signals& s, const std::vector<Vec3>& sensor, int axis) {
  double longest = 0.0;
  for (std::size_t k = 0, first = 0; k < s.size(); ++k) {
    const bool breaks = k > 0 && !(s.time[k] - s.time[k - 1] < longest_step * s.interval);
    if (!std::isfinite(sensor[k][axis])) {
      first = k + 1;
      continue;
    }
    if (breaks) first = k;
    longest = std::max(longest, s.time[k] - s.time[first]);
  }
  return longest;
}

/// The least and the greatest of some numbers.
struct Extremes {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void add(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  double range() const { return high - low; }
};

}  // namespace

std::string why_no_dwell(const Signals& signals, double static_min, double longest_quiet) {
  const std::string none = fmt::format(
      "no dwell of {} s in which both sensors are quiet (one or more is expected)", static_min);
  const double lasts = signals.time.back() - signals.time.front();
  if (lasts < static_min)
    return fmt::format(
        "{}: by its times the recording lasts {:.3g} s. If that is wrong, correct the unit of the "
        "times, as time [ms], in the header; or lower plan.static_min",
        none, lasts);
  std::vector<std::string> dead;
  for (const auto* sensor : {&signals.gyro, &signals.acc})
    for (int a = 0; a < 3; ++a)
      if (const double s = longest_measured(signals, *sensor, a); s < static_min)
        dead.push_back(fmt::format("{}_{} ({:.3g} s at most)",
                                   sensor == &signals.gyro ? "gyro" : "acc", "xyz"[a], s));
  if (dead.empty() && longest_quiet > 0.0 && longest_quiet < static_min) {
    const double window = DwellOptions{}.window;
    return fmt::format(
        "{}: the longest quiet stretch lasts {:.3g} s, of a rest of about {:.3g} s, as quiet is "
        "judged over {:g} s: a rest has to last {:.3g} s to be quiet for {:g} s. Rest the case for "
        "longer, or lower plan.static_min",
        none, longest_quiet, longest_quiet + window, window, static_min + window, static_min);
  }
  if (dead.empty()) return none + ". Rest the case, or lower plan.static_min";
  return fmt::format(
      "{}: {} {} not measured without a break for so long, where what stands still or is at the "
      "end "
      "of its range is left out as stuck. Look at the sensor and its column",
      none, listed(dead, "and"), dead.size() == 1 ? "is" : "are");
}

void require_live_accelerometers(const std::vector<Dwell>& dwells, const std::string& source) {
  constexpr std::size_t fewest = 4;
  constexpr double same = 0.05, varies = 0.6;  // [g]
  if (dwells.size() < fewest) return;
  for (int a = 0; a < 3; ++a) {
    Extremes its, others;
    for (const Dwell& d : dwells) {
      its.add(d.acc[a]);
      others.add(std::hypot(d.acc[(a + 1) % 3], d.acc[(a + 2) % 3]));
    }
    if (!(its.range() < same) || !(others.range() > varies)) continue;
    throw InputError(
        ExitCode::recording,
        fmt::format(
            "{0}:acc_{1}: in {2} rests it reads {3:.3f} to {4:.3f} g while the two other "
            "accelerometers together read {5:.3f} to {6:.3f} g: it does not follow gravity, "
            "of which the three see 1 g in any attitude. Look at the sensor and its column",
            source, "xyz"[a], dwells.size(), its.low, its.high, others.low, others.high));
  }
}

}  // namespace drift::strapdown
