#pragma once

#include <limits>

namespace drift {

/// Where a number is not known: a channel that says nothing, a statistic of too few runs.
inline constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

}  // namespace drift
