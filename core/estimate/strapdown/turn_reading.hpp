#pragma once

#include <vector>

#include "core/estimate/strapdown/signals.hpp"
#include "core/physics/assembly.hpp"

namespace drift::strapdown {

/// Turn of the case from sample k - 1 to sample k, a rotation vector:
///
///   <w> dt + dt^3 / (12 T) w_a x w_b    <w>: mean_between(),
///
/// w_a and w_b what the two samples read and T what lies between what they are read over: of
/// instants, and of the middles of means over even intervals, dt. Of means these are the angles
/// that were gained: alpha_b + alpha_a x alpha_b / 12 (Savage, J. Guidance, Control, and Dynamics
/// 21(1), 1998); of instants the cubic's mean, and w_a x w_b dt^2 / 12. w_a x w_b is T times the
/// rate cross the acceleration in the middle, up to T^3: either lacks dt^5 of a turn, of a motion
/// that goes round (coning) the fourth order in the interval, and the second where one is taken for
/// the other. drift: what the gyros read at rest.
Vec3 turned(const Signals& signals, std::size_t k, const Vec3& drift);

/// Whether the rate changes at sample k by so much of itself that half a sample is more than 5e-4
/// of a turn's whole acceleration. Where in a sample its rate was read nobody says: a row that ends
/// there would not know how much of the acceleration is its own.
bool speeds_up(const Signals& signals, std::size_t k);

/// Specific force in case axes at each sample of a way, carried by the gyros from the nearer of the
/// two dwells that it lies between. before, after: what is read in these [g].
std::vector<Vec3> carried_force(const Signals& signals, std::size_t first, std::size_t last,
                                const Vec3& before, const Vec3& after);

/// What is read over a row in which the case turns.
struct TurnReading {
  Vec3 acc = Vec3::Zero();  ///< mean output of the accelerometers, had the case turned evenly [g]
  CaseTurn turn;
};

/// Means from sample `first` to sample `last`: over the samples of means, of instants by the
/// trapezoid. Gyros and accelerometers are both instants, or both means over one interval. A row
/// is predicted as an even turn; where the rate changes within it, the case does not face gravity
/// as in an even one. What that makes,
///
///   (<C_even^T> - <C^T>) f,   C: against the attitude at the beginning,
///
/// is added to the reading. f_first: specific force at the beginning, as carried_force() has it
/// [g]; gravity [m/s^2].
TurnReading turn_reading(const Signals& signals, std::size_t first, std::size_t last,
                         const Vec3& f_first, double gravity);

}  // namespace drift::strapdown
