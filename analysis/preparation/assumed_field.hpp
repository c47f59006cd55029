#pragma once

#include "core/plan/timeline.hpp"

namespace drift::preparation {

/// The geomagnetic field where nobody has measured it: of a dipole along the axis of the Earth,
/// local axes North, West, Up [T]. Within a third in size and 20 deg in direction over most of the
/// Earth; what it decides is the pattern over attitudes, which hangs on its direction.
/// latitude [rad]. Source: first degree of IGRF-13, epoch 2020: 29.8 uT at the equator.
Vec3 dipole_field_l(double latitude);

/// Whether a field had to be assumed.
enum class FieldKnown { declared_or_recorded, assumed };

/// Gives a timeline that has no field that of the dipole.
FieldKnown assume_field(Timeline& timeline, double latitude);

}  // namespace drift::preparation
