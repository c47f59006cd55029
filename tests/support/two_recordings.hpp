#pragma once

#include "core/plan/timeline.hpp"
#include "core/sim/measurements.hpp"

namespace drift::test {

/// A test recorded twice: one recording after the other, as several are joined.
inline Timeline twice(const Timeline& once) {
  Timeline both = once;
  std::vector<Mat3> R_lp(static_cast<std::size_t>(2 * once.chains));
  const double shift = once.intervals.back().t1 - once.intervals.front().t0;
  for (Interval i : once.intervals) {
    if (i.cage)
      for (const int chain : {i.chain, i.chain + once.chains})
        R_lp[static_cast<std::size_t>(chain)] = once.nodes[i.first_node].R_lr;
    i.t0 += shift;
    i.t1 += shift;
    i.chain += once.chains;
    both.intervals.push_back(i);
  }
  both.chains = 2 * once.chains;
  place_nodes(both, R_lp);
  return both;
}

inline Measurements one_after_the_other(const Measurements& a, const Measurements& b) {
  Measurements both{Mat3X(3, a.acc.cols() + b.acc.cols()), Mat3X(3, a.acc.cols() + b.acc.cols())};
  both.acc << a.acc, b.acc;
  both.gimbal << a.gimbal, b.gimbal;
  return both;
}

}  // namespace drift::test
