#pragma once

#include "core/config/section.hpp"
#include "core/physics/triads.hpp"

namespace drift {

/// Reads [mounting]: gyro_x = "x y z" (input, output, spin), accelerometer_x = "x y z" (input,
/// pendulous, output), and y, z; each letter may have a minus sign. The input axis is the
/// instrument's own, the three are right-handed. What is absent keeps its default.
Mounting read_mounting(config::Section section);

}  // namespace drift
