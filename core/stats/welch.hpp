#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/stats/allan.hpp"

namespace drift::stats {

/// One-sided power spectral density: white noise of N per square root of a second has 2 N^2.
struct Spectrum {
  std::vector<double> frequency;  ///< [Hz], without zero
  std::vector<double> density;    ///< square of the rate per Hz
  std::size_t segments = 0;       ///< that it is the mean of
};

/// Welch's method over the stretches: segments of a power of two samples, at most a quarter of the
/// longest stretch and 8192, half overlapping, each without its mean, Hann window. Empty where no
/// stretch has 32 samples.
///
/// Source: P. D. Welch, IEEE Trans. Audio and Electroacoustics 15, 1967.
Spectrum welch(std::span<const Stretch> stretches, double interval);

/// The same averaged over frequencies, at least `per_decade` values a decade where there are so
/// many: what a logarithmic picture shows.
Spectrum thinned(const Spectrum& spectrum, int per_decade);

}  // namespace drift::stats
