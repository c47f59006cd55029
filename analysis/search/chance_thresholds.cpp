#include "analysis/search/chance_thresholds.hpp"

#include <algorithm>

#include "analysis/inference/thresholds.hpp"

namespace drift::search {

using inference::SearchLimits;

ChanceThresholds chance_thresholds(const Field& field, double alpha, int draws) {
  ChanceThresholds n{inference::MaxNull(field.projected.C, field.all_contrasts(), draws, 1),
                     inference::scan_null(field.scans, std::max(200, draws / 4))};
  n.library_threshold = n.library.threshold(alpha * SearchLimits::library_share);
  // A window by chance must not rule out a cause: thousands are looked at.
  n.scan_threshold = n.scan.threshold(alpha * SearchLimits::scan_share / SearchLimits::scan_cut);
  return n;
}

}  // namespace drift::search
