#pragma once

#include <optional>

#include "core/base/units.hpp"
#include "core/physics/earth.hpp"
#include "core/plan/row_mistake.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// Units that the rates of commands may be in.
inline constexpr Unit rate_units[] = {"rad/s"_unit, "deg/s"_unit, "arcmin/s"_unit, "arcsec/s"_unit,
                                      "deg/h"_unit, "rad/h"_unit, "mrad/s"_unit};

/// [rad/s] No drift is so fast: a slower command is no slew.
inline constexpr double fastest_drift = 20.0 * detail::earth_rate;

/// Attitude of the platform against the local axes, as gimbal angles [rad] and the heading of the
/// case in a row show it.
Mat3 local_attitude_shown(const Recording& recording, std::size_t row, const Vec3& angles);

/// Attitude of the platform against an inertial frame, as gimbal angles [rad] of a row show it.
Mat3 attitude_shown(const Recording& recording, const Site& site, std::size_t row,
                    const Vec3& angles);

/// Whether the platform turned as it was commanded in the slews of a recording, as the gimbals
/// show: a slew is hundreds of times as fast as the Earth and any drift. Where it did not in most
/// rows of slews: the columns of commands or of gimbals that are exchanged or reversed, or the unit
/// of the commands or of the gimbals, if one of these explains it. Where it did in most, the
/// columns of commands by which three turns that were otherwise, and none that was not, become as
/// commanded. gimbals_as_planned: they show the attitudes of the plan, so the commands are wrong.
/// Empty where it did, or nothing tells.
std::optional<RowMistake> slew_mistake(const Recording& recording, const Timeline& timeline,
                                       bool gimbals_as_planned);

}  // namespace drift
