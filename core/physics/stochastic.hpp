#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/physics/model_spec.hpp"

namespace drift {

/// What the terms that are random do, in the truth (one realisation) and in a filter (their
/// variance). They act through D_F of each gyro or on single samples, so no other hook is needed.

inline bool walks(const TermMask& terms) {
  constexpr std::size_t term = TermLibrary::term_index("drift_random_walk");
  return terms[term];
}
inline bool is_bistable(const TermMask& terms) {
  constexpr std::size_t term = TermLibrary::term_index("bistable_drift");
  return terms[term];
}
inline bool has_outliers(const TermMask& terms) {
  constexpr std::size_t term = TermLibrary::term_index("outliers");
  return terms[term];
}

/// Random walk of D_F of gyro `axis` [rad/s/sqrt(s)]: the study's `drift_random_walk` and the
/// term's q.
inline double drift_walk(const ProcessNoise& noise, const TermMask& terms, const Theta& theta,
                         int axis) {
  constexpr std::size_t q = TermLibrary::index("q_x");
  return walks(terms) ? std::hypot(noise.drift_random_walk, theta[q + axis])
                      : noise.drift_random_walk;
}

/// Half the distance of the two levels of gyro `axis` [rad/s].
inline double bistable_size(const Theta& theta, int axis) {
  constexpr std::size_t B = TermLibrary::index("B_x");
  return theta[B + axis];
}
/// How long a level lasts on average [s].
inline double bistable_dwell(const Theta& theta) {
  return theta[TermLibrary::index("B_dwell")];
}
/// Probability that the level is the other one a time T [s] later: telegraph noise whose levels
/// last for B_dwell on average.
inline double flip_probability(const Theta& theta, double T) {
  return 0.5 * (1.0 - std::exp(-2.0 * T / bistable_dwell(theta)));
}

/// Variance that D_F of gyro `axis` gains over T [s], for a filter [(rad/s)^2]. Telegraph noise +-B
/// changes by 2 B with probability p(T), so its increments have the variance 4 B^2 p(T); taken as
/// independent of each other they make the filter follow jumps, and forget more than it needs to.
inline double drift_variance(const ProcessNoise& noise, const TermMask& terms, const Theta& theta,
                             int axis, double T) {
  const double q = drift_walk(noise, terms, theta, axis);
  double variance = q * q * T;
  if (is_bistable(terms)) {
    const double B = bistable_size(theta, axis);
    variance += 4.0 * B * B * flip_probability(theta, T);
  }
  return variance;
}
/// Variance of the change of D_F of gyro `axis` from the beginning of a recording to that of
/// another one of the same unit, for a filter [(rad/s)^2]: each walk begins at the unit's D_F, and
/// each time it is a toss which of its two levels a bistable drift is on.
inline double drift_variance_between_recordings(const TermMask& terms, const Theta& theta,
                                                int axis) {
  if (!is_bistable(terms)) return 0.0;
  const double B = bistable_size(theta, axis);
  return 2.0 * B * B;
}

/// A term that makes D_F vary at random.
struct DriftNoise {
  std::size_t term;
  double (*size)(const Theta& theta, int axis);  ///< of gyro `axis` [SI]; zero: it is still
};
/// All there are. A platform with one of them is driven; an estimator that does not model it is
/// refused.
inline constexpr DriftNoise drift_noises[] = {
    {TermLibrary::term_index("drift_random_walk"),
     [](const Theta& theta, int axis) { return theta[TermLibrary::index("q_x") + axis]; }},
    {TermLibrary::term_index("bistable_drift"), bistable_size}};

inline bool drift_varies(const ProcessNoise& noise, const TermMask& terms) {
  return noise.drift_random_walk > 0.0 ||
         std::ranges::any_of(drift_noises, [&](const DriftNoise& n) { return terms[n.term]; });
}

inline bool drift_varies(const ModelSpec& spec) {
  return drift_varies(spec.noise, spec.model().terms);
}

/// Whether something random drives the platform.
inline bool has_process_noise(const ModelSpec& spec) {
  return spec.noise.any() || drift_varies(spec);
}

/// The model with D_F in it where something random acts through D_F, whether or not it has a
/// constant one.
inline DriftModel with_random_drift(const ProcessNoise& noise, DriftModel model) {
  constexpr std::size_t fixed = TermLibrary::term_index("fixed_drift");
  if (drift_varies(noise, model.terms)) model.terms.set(fixed);
  return model;
}

inline double outlier_rate(const Theta& theta) {
  return theta[TermLibrary::index("outlier_rate")];
}
inline double outlier_size(const Theta& theta) {
  return theta[TermLibrary::index("outlier_size")];
}
inline double outlier_gate(const Theta& theta) {
  return theta[TermLibrary::index("outlier_gate")];
}

}  // namespace drift
