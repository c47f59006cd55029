#include "core/stats/median.hpp"

#include <algorithm>

#include "core/base/nan.hpp"

namespace drift::stats {

double upper_median(std::vector<double> values) {
  if (values.empty()) return nan_value;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median(std::vector<double> values) {
  if (values.size() % 2 == 1) return upper_median(std::move(values));
  if (values.empty()) return nan_value;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace drift::stats
