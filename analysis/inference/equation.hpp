#pragma once

#include <string>

namespace drift::inference {

/// The kinds of equation in which something unmodelled may act.
enum class Equation { rate, attitude, accelerometer, gimbal };

/// "platform rate y", "gimbal middle".
std::string equation_name(Equation equation, int axis);

}  // namespace drift::inference
