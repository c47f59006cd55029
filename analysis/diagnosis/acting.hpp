#pragma once

#include <optional>
#include <span>

#include "analysis/inference/equation.hpp"
#include "analysis/search/cause.hpp"

namespace drift::diagnosis {

/// Where a cause acts, by what its term adds to: nothing of it is estimated from the misfit.
struct Acting {
  inference::Equation equation = inference::Equation::rate;
  /// Of the platform, the accelerometer or the gimbal: its own, or that of its largest size [prior
  /// sigmas]; empty where neither has one.
  std::optional<int> axis;
  std::optional<double> onset;  ///< it acts from then on [s]; empty: always
};

/// Empty of a cause that acts through random numbers alone.
std::optional<Acting> acting_of(const search::Cause& cause);

/// Where each of some causes acts, in their order; none where one of them is random.
std::vector<Acting> acting_of(std::span<const search::Cause> causes);

}  // namespace drift::diagnosis
