#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/stats/allan.hpp"

namespace drift::stats {

/// A stretch without its polynomial of this degree (least squares); shorter ones become zero.
/// times: of its samples, rising, in any unit; empty: evenly spaced.
Stretch without_trend(const Stretch& stretch, int degree, std::span<const double> times = {});

/// Stretches of one sensor without their polynomials, and how many samples are none: the farthest
/// of each from its polynomial, and what is nearly as far, is put on it, and the polynomial fitted
/// again, as long as it is farther than Gaussian noise would have any sample of all with
/// `by_chance`; that noise by the median of the distances, which a few wild ones do not move. No
/// more than one sample in ten of all. times: of each stretch, as above; none: evenly spaced.
struct Detrended {
  std::vector<Stretch> stretches;
  std::size_t isolated = 0;
};
Detrended without_trend_and_isolated(std::vector<Stretch> stretches, int degree, double by_chance,
                                     const std::vector<std::vector<double>>& times = {});

}  // namespace drift::stats
