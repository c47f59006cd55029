#include "analysis/blind/noise_faults.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <vector>

#include "analysis/blind/generate.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "core/base/check.hpp"

namespace drift::blind {
namespace {

/// Between two ends, evenly in the logarithm.
double between(double low, double high, Stream& stream) {
  return low * std::pow(high / low, stream.uniform());
}

/// Exponentially correlated noise of unit variance at the intervals, three of it: exact for any
/// spacing.
Mat3X correlated(const World& world, double tau, Stream& stream) {
  Mat3X out(3, world.intervals());
  Vec3 x;
  for (int a = 0; a < 3; ++a) x[a] = stream.normal();
  double t = world.timeline.intervals.front().t0;
  for (Eigen::Index i = 0; i < out.cols(); ++i) {
    const Interval& interval = world.timeline.intervals[static_cast<std::size_t>(i)];
    const double keep = std::exp(-(interval.t1 - t) / tau);
    for (int a = 0; a < 3; ++a) x[a] = keep * x[a] + std::sqrt(1.0 - keep * keep) * stream.normal();
    out.col(i) = x;
    t = interval.t1;
  }
  return out;
}

/// A value of unit variance for each chain, three of it.
Mat3X of_each_chain(const World& world, Stream& stream) {
  Mat3X out(3, world.intervals());
  Vec3 x;
  for (Eigen::Index i = 0; i < out.cols(); ++i) {
    if (i == 0 || world.timeline.intervals[static_cast<std::size_t>(i)].cage)
      for (int a = 0; a < 3; ++a) x[a] = stream.normal();
    out.col(i) = x;
  }
  return out;
}

HiddenParameter minutes(std::string key, double seconds) {
  return {std::move(key), seconds / 60.0, "min"};
}

using HiddenParameters = std::vector<HiddenParameter>;

/// All sensors are 0.75 to 1.6 times as noisy as declared.
HiddenParameters scaled_noise(World& world, Stream& stream) {
  const double factor = between(0.75, 1.6, stream);
  world.acc_factor = world.gimbal_factor = factor;
  return {{"factor", factor, "1"}};
}

/// 3e-4 to 3e-3 deg/sqrt(h).
HiddenParameters walking_angle(World& world, Stream& stream) {
  const double arw = between(3e-4, 3e-3, stream);
  world.truth.noise.angle_random_walk = arw * unit::deg_per_sqrt_h.to_si;
  return {{"q", arw, "deg/sqrt(h)"}};
}

/// 1e-3 to 5e-3 deg/h/sqrt(h).
HiddenParameters walking_drift(World& world, Stream& stream) {
  const double q = between(1e-3, 5e-3, stream);
  world.truth.noise.drift_random_walk = q * unit::deg_per_h_per_sqrt_h.to_si;
  return {{"q", q, "deg/h/sqrt(h)"}};
}

/// 2e-3 to 1e-2 deg/h, correlated over 10 to 60 min.
HiddenParameters wandering_drift(World& world, Stream& stream) {
  const double sigma = between(2e-3, 1e-2, stream), tau = between(600.0, 3600.0, stream);
  World::add(world.disturbance, correlated(world, tau, stream), sigma * unit::deg_per_h.to_si);
  return {{"sigma", sigma, "deg/h"}, minutes("tau", tau)};
}

/// 0.5 to 1.5 declared sigmas, correlated over 3 to 15 min.
HiddenParameters wandering_accelerometers(World& world, Stream& stream) {
  const double factor = between(0.5, 1.5, stream), tau = between(180.0, 900.0, stream);
  World::add(world.acc_error, correlated(world, tau, stream),
             factor * world.readout.accelerometer_noise);
  return {{"factor", factor, "1"}, minutes("tau", tau)};
}

/// 3e-3 to 3e-2 deg/h.
HiddenParameters drift_of_each_caging(World& world, Stream& stream) {
  const double sigma = between(3e-3, 3e-2, stream);
  World::add(world.disturbance, of_each_chain(world, stream), sigma * unit::deg_per_h.to_si);
  return {{"sigma", sigma, "deg/h"}};
}

/// 0.1 to 1 % of the samples are wrong by 10 sigma.
HiddenParameters wrong_samples(World& world, Stream& stream) {
  const double rate = between(1e-3, 1e-2, stream);
  constexpr double size = 10.0;
  Mat3X acc = Mat3X::Zero(3, world.intervals()), gimbal = acc;
  for (Mat3X* m : {&acc, &gimbal})
    for (Eigen::Index i = 0; i < m->cols(); ++i)
      for (int a = 0; a < 3; ++a)
        if (stream.uniform() < rate) (*m)(a, i) = stream.uniform() < 0.5 ? -size : size;
  World::add(world.acc_error, acc, world.readout.accelerometer_noise);
  World::add(world.gimbal_error, gimbal, world.readout.gimbal_noise);
  return {{"rate", rate, "1"}, {"size", size, "sigma"}};
}

/// Trials take turns at them: one more changes what is hidden in those of old seeds. Sizes:
/// physics.md 4, entries 8 to 11, 50, and 3.4.
constexpr struct {
  std::string_view term, words;
  HiddenParameters (*spoil)(World& world, Stream& stream);  ///< draws the numbers of the kind
} kinds[] = {
    {"noise_scale", "white noise not as declared", scaled_noise},
    {"angle_random_walk", "white noise of the gyros", walking_angle},
    {"drift_random_walk", "random walk of the drift", walking_drift},
    {"markov_drift", "correlated noise of the drift", wandering_drift},
    {"coloured_accelerometer", "correlated noise of the accelerometers", wandering_accelerometers},
    {"caging_drift", "another drift after each caging", drift_of_each_caging},
    {"outliers", "wrong samples", wrong_samples}};

/// In which the noise of a covariate is drawn. Temperature and field take turns at one, as they did
/// when there were no others: trials of old seeds stay what they were.
std::uint32_t noise_stream(const CovariateSpec& c) {
  return choice_stream + std::max(covariate("field").stream, c.stream);
}

/// 1 sigma of the noise of a covariate [SI]: a part of what it varies by (rms), of a vector of its
/// size.
double size_of_noise(const Timeline& timeline, const CovariateSpec& c, Stream& stream) {
  double square = 0.0, largest = 0.0;
  for (const Interval& i : timeline.intervals) {
    const double size = c.is_vector() ? i.around1.vector(c).norm() : i.around1[c];
    square += size * size;
    largest = std::max(largest, size);
  }
  if (c.is_vector()) return largest * between(0.01, 0.05, stream);
  return std::sqrt(square / static_cast<double>(timeline.intervals.size())) *
         between(0.1, 0.5, stream);
}

}  // namespace

std::size_t noise_fault(std::string_view term) {
  const auto found = std::ranges::find(kinds, term, [](const auto& kind) { return kind.term; });
  DRIFT_DEMAND(found != std::end(kinds));
  return static_cast<std::size_t>(found - std::begin(kinds));
}

HiddenEffect spoil_noise(std::size_t turn, World& world, Stream& stream) {
  const auto* kind = &kinds[turn % std::size(kinds)];
  if (kind->spoil == drift_of_each_caging &&
      static_cast<std::size_t>(world.timeline.chains) <= inference::least_cagings)
    kind = &kinds[noise_fault("markov_drift")];
  HiddenEffect e;
  e.term = kind->term;
  e.words = kind->words;
  e.parameters = kind->spoil(world, stream);
  return e;
}

Timeline with_noisy_covariates(Timeline timeline, std::uint64_t seed, std::uint64_t trial,
                               std::span<const CovariateSpec> covariates) {
  std::map<std::uint32_t, std::vector<CovariateSpec>> sharing;
  for (const CovariateSpec& c : covariates) sharing[noise_stream(c)].push_back(c);
  for (const auto& [index, turns] : sharing) {
    Stream stream(seed, trial, Purpose::design, index);
    std::vector<double> sigma;
    for (const CovariateSpec& c : turns) sigma.push_back(size_of_noise(timeline, c, stream));
    for (Interval& interval : timeline.intervals)
      for (std::size_t j = 0; j < turns.size(); ++j)
        for (std::size_t i = 0; i < turns[j].components(); ++i)
          interval.around1.value[turns[j].first + i] += sigma[j] * stream.normal();
  }
  for (std::size_t k = 1; k < timeline.intervals.size(); ++k)
    timeline.intervals[k].around0 = timeline.intervals[k - 1].around1;
  return timeline;
}

}  // namespace drift::blind
