#pragma once

#include "analysis/identification/identify.hpp"
#include "analysis/preparation/recorded_test.hpp"

namespace drift::identification {

/// Where the magnetic field of a test had to be assumed and a filter has what follows it, the error
/// of the field goes into the covariances of its estimates, of all its parameters: a parameter that
/// is considered and not estimated (Schmidt 1966),
///
///   P += S Sigma S^T,
///
/// S the change of the estimates with the field, by fits with one that is a quarter of a sigma to
/// both sides of each axis, Sigma that of a field beside the dipole's (preparation::beside_dipole).
/// Elsewhere nothing is changed. study and test: as the runs of `id` were estimated from.
void consider_field(const mc::Study& study, const preparation::RecordedTest& test,
                    Identification& id);

}  // namespace drift::identification
