#include <algorithm>
#include <cmath>

#include "analysis/report/noise/noise.hpp"
#include "analysis/report/noise/noise_units.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/plan/readout_config.hpp"

namespace drift::report {
namespace {

using preparation::ChannelNoise, preparation::NoiseCard;
using stats::AllanCoefficient, stats::AllanNoise;

/// Root mean square over the channels of a sensor; 0 where one does not have it.
double over_axes(const NoiseCard& card, Sensor sensor, auto&& value) {
  double squares = 0.0, count = 0.0;
  for (const ChannelNoise& c : card.channels) {
    if (sensor_of(c.channel) != sensor) continue;
    const double v = value(c);
    if (!(v > 0.0)) return 0.0;
    squares += v * v;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// What one sample scatters: white noise and quantisation averaged over its interval.
double of_one_sample(const ChannelNoise& c, double interval) {
  const auto slopes = stats::allan_slopes(interval);
  double variance = 0.0;
  for (const AllanNoise noise : {AllanNoise::quantisation, AllanNoise::white}) {
    const AllanCoefficient& k = c.fit[noise];
    if (k.found) variance += k.value * k.value * slopes[static_cast<Eigen::Index>(noise)];
  }
  return std::sqrt(variance);
}

/// A coefficient that is there for sure, and surely of this kind.
double certain(const ChannelNoise& c, AllanNoise noise) {
  return c.fit[noise].found && c.fit[noise].rivals.empty() ? c.fit[noise].value : 0.0;
}

bool all_fit(const NoiseCard& card, Sensor sensor) {
  for (const ChannelNoise& c : card.channels)
    if (sensor_of(c.channel) == sensor && !c.fit.fits) return false;
  return true;
}

}  // namespace

std::string noise_keys(const NoiseCard& card) {
  std::string out;
  const auto unsure = [&](Sensor sensor) {
    return all_fit(card, sensor) ? "" : "; it is not white alone: see misfit";
  };
  if (const double sigma =
          over_axes(card, Sensor::accelerometer,
                    [&](const ChannelNoise& c) { return of_one_sample(c, card.interval); });
      sigma > 0.0)
    out += fmt::format(
        "[readout]\naccelerometer_noise = \"{} ug\"  # of one sample of {} s{}\n",
        number_text(std::max(sigma, least_noise("accelerometer_noise")) / unit::ug.to_si),
        number_text(card.interval, 4), unsure(Sensor::accelerometer));
  const auto units = noise_units(Sensor::gyro, 1.0);
  constexpr std::pair<AllanNoise, std::string_view> keys[] = {
      {AllanNoise::white, "angle_random_walk"}, {AllanNoise::rate_walk, "drift_random_walk"}};
  for (const auto& line : keys) {
    const AllanNoise noise = line.first;
    const double value =
        over_axes(card, Sensor::gyro, [&](const ChannelNoise& c) { return certain(c, noise); });
    const NoiseUnit& unit = units[static_cast<std::size_t>(noise)];
    if (value > 0.0)
      out += fmt::format("# in a [[filter]] of a platform with these gyros: {} = \"{} {}\"{}\n",
                         line.second, number_text(value / unit.size), unit.symbol,
                         unsure(Sensor::gyro));
  }
  return out;
}

}  // namespace drift::report
