#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/plan/timeline.hpp"
#include "core/sim/measurements.hpp"

namespace drift::preparation {

/// The rows of a position that dwell.
struct Dwell {
  int position = 0;  ///< from 0
  std::vector<std::size_t> rows;
};

/// Every stretch of rows of one position without its slews, in the order of the test.
std::vector<Dwell> dwells_of(const Timeline& timeline);

/// How the platform turns against the local axes in a dwell, and which components of that are seen.
struct Turn {
  Vec3 rate_l = Vec3::Zero();  ///< [rad/s]
  Vec3 seen = Vec3::Zero();    ///< 1 or 0 by local axis
};

/// Read off the gimbals, else off Up as the accelerometers see it from the nominal attitude, over
/// PlanLimits::longest_turn at most. Empty where two rows of neither were measured.
std::optional<Turn> turn_of(const Dwell& dwell, const Timeline& timeline,
                            const Measurements& measured, const Position& position);

}  // namespace drift::preparation
