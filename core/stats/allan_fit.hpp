#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/stats/allan.hpp"
#include "core/stats/allan_covariance.hpp"

namespace drift::stats {

/// One averaging time: the Allan deviation, and the interval that holds the true one with 95 %.
struct AllanPoint {
  double tau = 0.0;        ///< [s]
  double deviation = 0.0;  ///< of the rate
  double dof = 0.0;        ///< equivalent degrees of freedom under the fitted noise
  double low = 0.0, high = 0.0;
  double fitted = 0.0;  ///< deviation of the fitted noise
};

/// One of the five coefficients. `found`: a series without it would show so much with a probability
/// of `p` only, below `allan_significance`; otherwise `value` is 0 and `upper` bounds it with 95 %.
struct AllanCoefficient {
  double value = 0.0, sigma = 0.0;  ///< in the unit of the rate times s^1, s^1/2, 1, s^-1/2, s^-1
  double upper = 0.0;
  double p = 1.0;
  bool found = false;
  /// Noises that explain the same as well in its place: which of them it is stays open.
  std::vector<AllanNoise> rivals = {};
};
inline constexpr double allan_significance = 0.01;

/// What the Allan variances of a series say.
struct AllanFit {
  std::vector<AllanPoint> points;
  std::array<AllanCoefficient, allan_noises> coefficients;  ///< Q N B K R
  /// Misfit of the five slopes: chi-square over its degrees of freedom, and whether chance alone
  /// makes it so (p above 0.001). Where it does not, every sigma is wider by its root.
  double misfit = 1.0;
  bool fits = true;

  const AllanCoefficient& operator[](AllanNoise noise) const {
    return coefficients[static_cast<std::size_t>(noise)];
  }
};

/// Fits Allan variances of one or more channels sampled alike: the covariance of the points depends
/// on lengths alone and is prepared once.
class AllanFitter {
 public:
  /// At most `most` samples are averaged. Lengths of stretches that are too short count for
  /// nothing.
  AllanFitter(std::span<const std::size_t> lengths, double interval,
              std::size_t most = std::numeric_limits<std::size_t>::max());

  /// Whether there is an averaging time at all, and as many an octave apart as more than white
  /// noise takes.
  bool possible() const { return !octaves_.empty(); }
  bool enough() const { return octaves_.size() >= 3; }

  /// sigma^2(tau) = 3 Q^2 / tau^2 + N^2 / tau + (2 ln 2 / pi) B^2 + K^2 tau / 3 + R^2 tau^2 / 2 by
  /// generalised least squares, no square negative, the covariance that of the fitted noise. The
  /// fit takes averaging times an octave apart: those between add next to nothing and make the
  /// covariance singular. Coefficients that are not distinguished from zero are taken out one by
  /// one, the least probable first. `noises`: those to be looked for.
  AllanFit fit(std::span<const Stretch> stretches,
               std::span<const AllanNoise> noises = all_noises) const;

  static constexpr std::array<AllanNoise, allan_noises> all_noises{
      AllanNoise::quantisation, AllanNoise::white, AllanNoise::flicker, AllanNoise::rate_walk,
      AllanNoise::ramp};

 private:
  std::vector<std::size_t> counts_, octaves_;
  double interval_;
  AllanCovariance each_, covariance_;  ///< diagonal for all counts, all pairs of octaves
};

}  // namespace drift::stats
