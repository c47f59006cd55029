#pragma once

#include <string_view>
#include <vector>

#include "core/sim/trajectory.hpp"

namespace drift {

/// How wrong a term's memory is because it follows the nominal path of the platform.
struct MemoryLeftOut {
  std::string_view term;
  /// Of its state that is most wrong: rms of the difference from the memory along the platform's
  /// own path, over the larger rms of the two. Of a friction: 1 is one that is there on one of the
  /// paths alone, 2 one of the other sign.
  double part = 0.0;
};

/// Compares the memory of a model's terms along the nominal path (MemoryPath) with that along the
/// path of integrate_fixed(), for each term with memory, in the order of the library. What the
/// difference would do to that path itself is of second order. theta: SI; psi0_l: attitude error of
/// each chain at its caging, local axes [rad].
std::vector<MemoryLeftOut> memory_left_out(const Timeline& timeline, const DriftModel& model,
                                           const Theta& theta, const std::vector<Vec3>& psi0_l);

}  // namespace drift
