#pragma once

#include <string>
#include <vector>

#include "core/base/linalg.hpp"
#include "core/base/units.hpp"

namespace drift::cli {

/// What accelerometers and gimbals show where a position begins.
struct TwoUps {
  std::size_t position = 0;  ///< from 1
  Vec3 force;                ///< in any unit
  Vec3 gimbals;              ///< outer, middle, inner [rad]
};

/// Whether accelerometers and gimbals show the same Up in every position, within 10 deg; if not, in
/// words: where, and every single thing that would make the two one (columns exchanged or of the
/// wrong sign, angles in another unit, the zero of one gimbal a quarter of a turn away). Which of
/// the two instruments is wrong nothing in a recording shows. `unit`: of the gimbal angles. Empty
/// where they agree.
std::string two_ups_text(const std::vector<TwoUps>& seen, const Unit& unit);

}  // namespace drift::cli
