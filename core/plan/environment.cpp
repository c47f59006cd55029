#include "core/plan/environment.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plan/timeline.hpp"

namespace drift {
namespace {

void set_field(Timeline& timeline, const Environment& e) {
  const Vec3 field_l(*e.field_n, *e.field_w, *e.field_u);
  timeline.has_field = true;
  for (Interval& i : timeline.intervals) i.around0.field_l = i.around1.field_l = field_l;
}

}  // namespace

void set_environment(Timeline& timeline, const Environment& e, std::uint64_t seed,
                     std::uint64_t run) {
  if (timeline.intervals.empty()) return;
  if (e.has_field()) set_field(timeline, e);
  if (!e.temperature) return;
  Stream stream(seed, run, Purpose::environment);
  const double fluctuation = e.temperature_fluctuation;
  const auto temperature = [&](double t) {
    const double w = 2.0 * std::numbers::pi / e.temperature_period;
    const double smooth =
        e.temperature_amplitude * std::sin(w * t + e.temperature_phase) + e.temperature_ramp * t;
    return smooth + (fluctuation > 0.0 ? fluctuation * stream.normal() : 0.0);
  };
  double last = temperature(0.0), sum = 0.0;
  for (Interval& i : timeline.intervals) {
    i.around0.temperature = last;
    i.around1.temperature = last = temperature(i.t1 - i.t_begin);
    sum += last;
  }
  // A recording holds the values at the ends of its intervals, and deviations are from their mean.
  const double mean = sum / static_cast<double>(timeline.intervals.size());
  for (Interval& i : timeline.intervals) {
    i.around0.temperature -= mean;
    i.around1.temperature -= mean;
  }
  // The first value is not in the recording: nothing is known of it but that it was near the next.
  timeline.intervals.front().around0.temperature = timeline.intervals.front().around1.temperature;
  timeline.has_temperature = true;
  timeline.mean_temperature = *e.temperature + mean;
}

void set_known_field(Timeline& timeline, const Environment& environment) {
  if (!timeline.has_field && environment.has_field()) set_field(timeline, environment);
}

}  // namespace drift
