#pragma once

#include <cstddef>
#include <vector>

#include "core/stats/allan.hpp"

namespace drift::stats {

/// A stretch without its polynomial of this degree (least squares) in time, which increases (any
/// unit; as many times as samples); shorter ones become zero.
Stretch without_trend(const Stretch& stretch, const std::vector<double>& time, int degree);

/// Stretches of one sensor without their polynomials, and how many samples are none: the farthest
/// of each from its polynomial, and what is nearly as far, is put on it, and the polynomial fitted
/// again, as long as it is farther than Gaussian noise would have any sample of all with
/// `by_chance`; that noise by the median of the distances, which a few wild ones do not move. No
/// more than one sample in ten of all. Samples are evenly spaced where no times are given.
struct Detrended {
  std::vector<Stretch> stretches;
  std::size_t isolated = 0;
};
Detrended without_trend_and_isolated(std::vector<Stretch> stretches,
                                     const std::vector<std::vector<double>>& times, int degree,
                                     double by_chance);
Detrended without_trend_and_isolated(std::vector<Stretch> stretches, int degree, double by_chance);

}  // namespace drift::stats
