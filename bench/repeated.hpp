#pragma once

#include <algorithm>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::bench {

struct Timed {
  double seconds = 0.0;
  long allocated = 0;
  MatX P;  ///< final covariance, attitude first
};

/// The quickest of several, and how far their median is from it.
struct Repeated {
  Timed best;
  std::vector<double> seconds;

  void add(const Timed& now) {
    if (seconds.empty() || now.seconds < best.seconds) best = now;
    seconds.push_back(now.seconds);
  }
  double spread() const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2] / best.seconds;
  }
};

}  // namespace drift::bench
