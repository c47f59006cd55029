#pragma once

#include <cmath>
#include <cstdint>

#include "core/base/rng.hpp"
#include "core/stats/allan.hpp"

namespace drift::test {

/// Coefficients of a made series, per sample interval of 1 s.
struct AllanTruth {
  double quantisation = 0.0, white = 1.0, rate_walk = 0.0, ramp = 0.0;
};

/// The rate averaged over each sample: white noise, a random walk averaged exactly over the sample
/// (half its step and an independent part of step / sqrt(12)), the difference of white angle noise,
/// and a ramp.
inline stats::Stretch made_stretch(const AllanTruth& t, std::size_t length, Stream& random) {
  stats::Stretch out;
  double walk = 0.0, angle = t.quantisation * random.normal();
  for (std::size_t k = 0; k < length; ++k) {
    const double step = t.rate_walk * random.normal();
    const double mean = walk + 0.5 * step + t.rate_walk * random.normal() / std::sqrt(12.0);
    walk += step;
    const double next = t.quantisation * random.normal();
    out.push_back(t.white * random.normal() + mean + (next - angle) +
                  t.ramp * static_cast<double>(k));
    angle = next;
  }
  return out;
}

}  // namespace drift::test
