#pragma once

#include "core/plan/environment.hpp"
#include "core/plan/timeline.hpp"

namespace drift::preparation {

/// The geomagnetic field where nobody has measured it: of a dipole along the axis of the Earth,
/// local axes North, West, Up [T]. What it decides is the pattern over attitudes, which hangs on
/// its direction. latitude [rad]. Source: first degree of IGRF-13, epoch 2020: 29.8 uT at the
/// equator.
Vec3 dipole_field_l(double latitude);

/// [T] an axis, root mean square over the Earth: what the field has beside that dipole. Source:
/// IGRF-13, epoch 2020, (n + 1) times the squares of the coefficients of degree n: 47.5 (the
/// equatorial dipole), 82.3, 38.8, 9.2 and, above degree 4, 3 (10^6 nT^2), shared by three axes.
inline constexpr double beside_dipole = 7.8e-6;

/// Whether a field had to be assumed.
enum class FieldKnown { declared_or_recorded, assumed };

/// Gives a timeline that has no field that of the dipole.
FieldKnown assume_field(Timeline& timeline, double latitude);

/// The same of what [environment] declares, for a test that is planned.
FieldKnown assume_field(Environment& environment, double latitude);

}  // namespace drift::preparation
