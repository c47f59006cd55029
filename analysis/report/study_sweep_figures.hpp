#pragma once

#include <optional>
#include <string>

#include "analysis/report/study_results.hpp"

namespace drift {

/// The number a value of a sweep stands for: of "20 arcsec" 20 arcsec, of 0.5 that, of a distribution
/// or table its last number. In SI, with the unit it was written in; empty if it holds none.
struct SweptNumber {
  double si = 0.0;
  Unit unit;
};
std::optional<SweptNumber> swept_number(const std::string& value);

/// Statistics against the swept value, one picture for each axis whose values are numbers.
std::vector<Picture> sweep_pictures(const StudyResults& results);

}  // namespace drift
