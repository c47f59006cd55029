#include "core/plan/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/rng.hpp"
#include "core/plan/timeline.hpp"

namespace drift {
namespace {

/// A number along a timeline that has intervals.
void set_number(Timeline& timeline, const CovariateSpec& c, const CovariateCourse& course,
                Stream stream) {
  const auto value = [&](double t) {
    const double w = 2.0 * std::numbers::pi / course.period;
    const double smooth = course.amplitude * std::sin(w * t + course.phase) + course.ramp * t;
    return smooth + (course.fluctuation > 0.0 ? course.fluctuation * stream.normal() : 0.0);
  };
  double last = value(0.0), sum = 0.0;
  for (Interval& i : timeline.intervals) {
    i.around0[c] = last;
    i.around1[c] = last = value(i.t1 - i.t_begin);
    sum += last;
  }
  // A recording holds the values at the ends of its intervals, and deviations are from their mean.
  const double mean = sum / static_cast<double>(timeline.intervals.size());
  for (Interval& i : timeline.intervals) {
    i.around0[c] -= mean;
    i.around1[c] -= mean;
  }
  // The first value is not in the recording: nothing is known of it but that it was near the next.
  timeline.intervals.front().around0[c] = timeline.intervals.front().around1[c];
  timeline.mean[c] = *course.mean.front() + mean;
  timeline.carried |= c.set();
}

void set_vector(Timeline& timeline, const CovariateSpec& c, const CovariateCourse& course) {
  timeline.set_vector(c, Vec3(*course.mean[0], *course.mean[1], *course.mean[2]));
}

}  // namespace

CovariateSet Environment::declared() const {
  CovariateSet set = 0;
  for (const CovariateSpec& c : known_covariates)
    if ((*this)[c].declared()) set |= c.set();
  return set;
}

bool Environment::fluctuates() const {
  return std::ranges::any_of(
      courses, [](const CovariateCourse& course) { return course.fluctuation > 0.0; });
}

void set_environment(Timeline& timeline, const Environment& e, std::uint64_t seed,
                     std::uint64_t run) {
  if (timeline.intervals.empty()) return;
  for (const CovariateSpec& c : known_covariates) {
    if (!e[c].declared()) continue;
    if (c.is_vector())
      set_vector(timeline, c, e[c]);
    else
      set_number(timeline, c, e[c], Stream(seed, run, Purpose::environment, c.stream));
  }
}

void set_declared_vectors(Timeline& timeline, const Environment& e) {
  for (const CovariateSpec& c : known_covariates)
    if (c.is_vector() && e[c].declared() && !timeline.carries(c)) set_vector(timeline, c, e[c]);
}

}  // namespace drift
