#pragma once

#include <vector>

#include "core/physics/earth.hpp"
#include "core/plan/test_plan.hpp"

namespace drift::planning {

/// Something that may be added to a plan: a caged position, or a caged position and one slewed to
/// from there.
using Addition = std::vector<Position>;

/// Additions that the gimbals allow at this site, with the dwell and sample interval given: the 24
/// orientations of a cube and 72 turned by 45 deg about one platform axis, case heading 0 and 90
/// deg, both command laws; those of the cube held three times as long; and slews from x=N y=W z=U
/// to the orientations of the cube.
std::vector<Addition> position_pool(double usual_dwell, double sample, const Site& site);

}  // namespace drift::planning
