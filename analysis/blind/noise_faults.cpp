#include "analysis/blind/noise_faults.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "analysis/blind/generate.hpp"
#include "analysis/inference/noise/noise_component.hpp"

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

HiddenEffect fault(std::string term, std::string words, std::vector<HiddenParameter> parameters) {
  HiddenEffect e;
  e.term = std::move(term);
  e.words = std::move(words);
  e.parameters = std::move(parameters);
  return e;
}

HiddenParameter minutes(std::string key, double seconds) {
  return {std::move(key), seconds / 60.0, "min"};
}

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

HiddenEffect spoil_noise(std::size_t kind, World& world, Stream& stream) {
  HiddenEffect e;
  constexpr std::size_t of_each_caging = 5, wandering = 3;
  kind %= num_noise_faults;
  if (kind == of_each_caging &&
      static_cast<std::size_t>(world.timeline.chains) <= inference::least_cagings)
    kind = wandering;
  switch (kind) {
    case 0: {
      const double factor = between(0.75, 1.6, stream);
      world.acc_factor = world.gimbal_factor = factor;
      e = fault("noise_scale", "white noise not as declared", {{"factor", factor, "1"}});
      break;
    }
    case 1: {
      const double arw = between(3e-4, 3e-3, stream);
      world.truth.noise.angle_random_walk = arw * unit::deg_per_sqrt_h.to_si;
      e = fault("angle_random_walk", "white noise of the gyros", {{"q", arw, "deg/sqrt(h)"}});
      break;
    }
    case 2: {
      const double q = between(1e-3, 5e-3, stream);
      world.truth.noise.drift_random_walk = q * unit::deg_per_h_per_sqrt_h.to_si;
      e = fault("drift_random_walk", "random walk of the drift", {{"q", q, "deg/h/sqrt(h)"}});
      break;
    }
    case 3: {
      const double sigma = between(2e-3, 1e-2, stream), tau = between(600.0, 3600.0, stream);
      World::add(world.disturbance, correlated(world, tau, stream), sigma * unit::deg_per_h.to_si);
      e = fault("markov_drift", "correlated noise of the drift",
                {{"sigma", sigma, "deg/h"}, minutes("tau", tau)});
      break;
    }
    case 4: {
      const double factor = between(0.5, 1.5, stream), tau = between(180.0, 900.0, stream);
      World::add(world.acc_error, correlated(world, tau, stream),
                 factor * world.readout.accelerometer_noise);
      e = fault("coloured_accelerometer", "correlated noise of the accelerometers",
                {{"factor", factor, "1"}, minutes("tau", tau)});
      break;
    }
    case of_each_caging: {
      const double sigma = between(3e-3, 3e-2, stream);
      World::add(world.disturbance, of_each_chain(world, stream), sigma * unit::deg_per_h.to_si);
      e = fault("caging_drift", "another drift after each caging", {{"sigma", sigma, "deg/h"}});
      break;
    }
    default: {
      const double rate = between(1e-3, 1e-2, stream);
      constexpr double size = 10.0;
      Mat3X acc = Mat3X::Zero(3, world.intervals()), gimbal = acc;
      for (Mat3X* m : {&acc, &gimbal})
        for (Eigen::Index i = 0; i < m->cols(); ++i)
          for (int a = 0; a < 3; ++a)
            if (stream.uniform() < rate) (*m)(a, i) = stream.uniform() < 0.5 ? -size : size;
      World::add(world.acc_error, acc, world.readout.accelerometer_noise);
      World::add(world.gimbal_error, gimbal, world.readout.gimbal_noise);
      e = fault("outliers", "wrong samples", {{"rate", rate, "1"}, {"size", size, "sigma"}});
      break;
    }
  }
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
