#pragma once

#include "analysis/blind/world.hpp"
#include "core/base/rng.hpp"

namespace drift::blind {

/// Effects that no term of the library describes, so that a diagnosis can find them but not name
/// them. They are patterns in time computed here, from the nominal path of the platform; nothing
/// that diagnoses uses this code.
///
///   product_drift      drift a_I^2 a_S of one gyro
///   gimbal_force       drift sin(3 gimbal angle) times specific force along an axis
///   intermittent       drift on in the second half of three positions alone
///   chirp              drift sin(2 pi (t/T0)^2), its period shrinking through the test
///   acc_pickup         accelerometer error with a period of 47 min that grows with |a|
///   resolver_sawtooth  resolver error that builds up over 25 min and falls back
Source outside_source(std::size_t kind, const World& world, Stream& stream);
inline constexpr std::size_t num_outside = 6;

/// A disturbance in one position, time window and equation: a constant rate of one platform axis,
/// or a constant error of one accelerometer or resolver, over half of a dwell or less.
Source local_source(const World& world, Stream& stream);

}  // namespace drift::blind
