#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace drift {

/// A parabola by least squares, at one instant.
struct ParabolaValue {
  double value = 0.0;
  double part =
      0.0;  ///< of a reading at that instant which is in it; its noise is less by the root
};

/// The parabola through what was read from `half` seconds before t to `half` seconds after it, at t
/// [s]. times: of the readings, in order; values: all finite. Empty where they are fewer than
/// `fewest`, four or more. Of a swing of period P it leaves 1 - (2 pi half / P)^4 / 280.
std::optional<ParabolaValue> parabola_at(const std::vector<double>& times,
                                         const std::vector<double>& values, double t, double half,
                                         std::size_t fewest);

}  // namespace drift
