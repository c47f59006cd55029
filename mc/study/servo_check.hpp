#pragma once

#include <string>

#include "core/config/report.hpp"
#include "mc/study/study.hpp"

namespace drift::mc {

/// Says where [truth.servo] makes a loop that is open about an axis (a singular motor_coupling) or
/// does not settle, with gyros turned by the misalignments of [truth] (servo_modes()). Nothing
/// where neither [truth.servo] is given nor the coupling is "servo".
void check_servo(const config::Node& root, const Study& study, config::Report& report);

/// A note, one line, where the loop of [truth] settles in longer than the shortest sample of the
/// plan: what it settles to, eq. (6), is then not what the rows show. Empty otherwise.
std::string slow_servo_text(const Study& study);

}  // namespace drift::mc
