#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>

#include "core/estimate/estimate_result.hpp"

namespace drift::test {

/// Errors of estimates in their own sigmas. Of n independent ones the rms is 1 +- 1 / sqrt(2 n).
struct Pulls {
  double squares = 0.0, worst = 0.0;
  std::size_t count = 0;

  double rms() const { return std::sqrt(squares / static_cast<double>(count)); }

  void add(const EstimateResult& estimate, const Theta& truth) {
    for (const ParameterEstimate& p : estimate.parameters) {
      const double z = (p.value - truth[static_cast<Eigen::Index>(p.param)]) / p.sigma;
      squares += z * z;
      worst = std::max(worst, std::abs(z));
      ++count;
    }
  }
};

/// Sigmas are neither too small nor too large.
inline void expect_as_large_as_sigmas(const Pulls& pulls, double most) {
  std::cout << pulls.count << " errors in sigmas: rms " << pulls.rms() << ", largest "
            << pulls.worst << "\n";
  EXPECT_GT(pulls.rms(), 0.8);
  EXPECT_LT(pulls.rms(), 1.25);
  EXPECT_LT(pulls.worst, most);
}

}  // namespace drift::test
