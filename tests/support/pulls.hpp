#pragma once

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstddef>
#include <iostream>

#include "core/estimate/estimate_result.hpp"

namespace drift::test {

/// Errors of estimates in their own sigmas, and all of them together by the covariance: those of
/// one unit hang together, so that their rms says little where units are few.
struct Pulls {
  double chi2 = 0.0;  ///< e' P^-1 e, summed over the estimates
  double squares = 0.0, worst = 0.0;
  std::size_t count = 0;

  double rms() const { return std::sqrt(squares / static_cast<double>(count)); }

  void add(const EstimateResult& estimate, const Theta& truth) {
    VecX error(estimate.covariance.rows());
    for (std::size_t k = 0; k < estimate.parameters.size(); ++k) {
      const ParameterEstimate& p = estimate.parameters[k];
      const double e = p.value - truth[static_cast<Eigen::Index>(p.param)];
      error[static_cast<Eigen::Index>(k)] = e / p.prior_sigma;
      squares += e * e / (p.sigma * p.sigma);
      worst = std::max(worst, std::abs(e) / p.sigma);
      ++count;
    }
    chi2 += error.dot(estimate.covariance.ldlt().solve(error));
  }
};

/// Errors are as large as their covariance says: their chi-square has a chance above 1e-4 on its
/// side, and none is larger than one of as many normal numbers is in 10,000 sets.
inline void expect_as_large_as_sigmas(const Pulls& pulls) {
  constexpr double chance = 1e-4;
  const auto n = static_cast<double>(pulls.count);
  const boost::math::chi_squared of_all(n), of_one(1.0);
  std::cout << pulls.count << " errors in sigmas: chi-square " << pulls.chi2 << ", rms "
            << pulls.rms() << ", largest " << pulls.worst << "\n";
  EXPECT_GT(pulls.chi2, quantile(of_all, chance));
  EXPECT_LT(pulls.chi2, quantile(complement(of_all, chance)));
  EXPECT_LT(pulls.worst, std::sqrt(quantile(complement(of_one, chance / n))));
}

}  // namespace drift::test
