#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace drift::stats {

/// Samples of a rate, evenly spaced and without a gap. A recording is several of them: nothing is
/// ever differenced from one to the next.
using Stretch = std::vector<double>;

/// Numbers of samples to average over, three to an octave (ten to a decade), from 1 to a third of
/// the longest stretch. Every third one is a power of two.
std::vector<std::size_t> averaging_counts(std::size_t longest);

/// The overlapping Allan variance at each of `counts`, pooled over the stretches: half the mean
/// square of the difference between the means of neighbouring groups of `count` samples, over all
/// places at which two groups fit into a stretch; NaN where they fit nowhere.
///
/// Source: IEEE Std 952-1997, annex C; Riley, NIST Special Publication 1065, 5.2.4.
std::vector<double> allan_variances(std::span<const Stretch> stretches,
                                    std::span<const std::size_t> counts);

/// At how many places two groups of `count` samples fit into a stretch of `length`.
inline std::size_t places(std::size_t length, std::size_t count) {
  return length + 1 > 2 * count ? length + 1 - 2 * count : 0;
}

}  // namespace drift::stats
