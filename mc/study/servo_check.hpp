#pragma once

#include <string>

#include "core/config/report.hpp"
#include "mc/study/study.hpp"

namespace drift::mc {

/// Says where [truth.servo] makes a loop that is open about an axis (a singular motor_coupling) or
/// does not settle, with gyros turned by the misalignments of [truth] (servo_modes()). Nothing
/// where neither [truth.servo] is given nor the coupling is "servo".
void check_servo(const config::Node& root, const Study& study, config::Report& report);

/// Notes, one line each, on a loop of [truth] that settles in longer than the shortest sample of
/// the plan (what it settles to, eq. (6), is then not what the rows show), and on a motion of the
/// base with an amplitude or a frequency alone, which is none. Empty where there is nothing to say.
std::string servo_notes(const Study& study);

}  // namespace drift::mc
