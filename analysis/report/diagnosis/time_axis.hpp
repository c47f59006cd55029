#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/where.hpp"

namespace drift::report {

/// Short recordings are shown in seconds, long ones in hours.
struct TimeAxis {
  double unit = 3600.0;  ///< [s]
  std::string label;
};
TimeAxis time_axis(const std::vector<double>& t, const diagnosis::Where& where);

}  // namespace drift::report
