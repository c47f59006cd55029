#pragma once

#include "core/plan/timeline.hpp"

namespace drift::strapdown {

/// What the Earth's horizontal rate, along a North that nobody knows, is as noise on each axis.
struct UnknownNorth {
  double variance = 0.0;  ///< of the mean rate over a dwell [(rad/s)^2]
  double walk = 0.0;      ///< over the ways, as a walk that makes as much of all of them [rad^2/s]
};

/// A third of its square, were every dwell a draw of its own. Neighbours are alike, by the turn
/// between them: means over all scatter by (1 + likeness) / (1 - likeness) more. A dwell and the
/// way from it see the same; as noise of their own they must have twice that to know together no
/// more than one of them. drift: of the gyros, in what the rows are commanded [rad/s].
UnknownNorth unknown_north(const Timeline& timeline, const Vec3& drift);

}  // namespace drift::strapdown
