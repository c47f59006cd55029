#pragma once

#include "analysis/search/fitted.hpp"

namespace drift::search {

/// Thresholds of a family of tests on one plan; they depend on the signatures, not on the data.
struct ChanceThresholds {
  inference::MaxNull library, scan;
  /// Strengths that are exceeded with probability alpha under the null, in each family.
  double library_threshold = 0.0, scan_threshold = 0.0;
};

ChanceThresholds chance_thresholds(const Field& field, double alpha, int draws);

}  // namespace drift::search
