#pragma once

#include <vector>

#include "core/estimate/estimate_result.hpp"

namespace drift::report {

/// Posterior correlations of the parameters, in the order of the layout; NaN where a sigma is zero.
MatX correlation_of(const EstimateResult& result);

/// Two states of a layout, one before other.
struct CorrelatedPair {
  std::size_t one = 0, other = 0;
  double correlation = 0.0;
};

/// All pairs, the strongest first.
std::vector<CorrelatedPair> strongest_pairs(const MatX& correlation);

}  // namespace drift::report
