#pragma once

#include <span>
#include <string>

#include "core/base/units.hpp"
#include "core/plan/timeline.hpp"

namespace drift::inference {

/// The kinds of equation in which something unmodelled may act.
enum class Equation { rate, attitude, accelerometer, gimbal };

/// Those in which something may be missing from a test: a strapdown unit has no gimbals, and stands
/// on the Earth as it is.
std::span<const Equation> equations_of(const Timeline& timeline);

/// What an input to it is shown in.
const Unit& unit_of(Equation equation);

/// "platform rate y", "gimbal middle".
std::string equation_name(Equation equation, int axis);

}  // namespace drift::inference
