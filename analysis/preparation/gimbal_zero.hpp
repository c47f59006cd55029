#pragma once

#include <string>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// Which gimbal reads too much or too little by a constant, as the accelerometers show, and what to
/// write; empty where no gimbal does, or where not one alone explains it.
///
/// In every row of a dwell two instruments show where Up is on the platform: the accelerometers,
/// and the middle and inner gimbal on a level case. The zero of one gimbal is fitted to what they
/// differ by. It is said where it is larger than GimbalZeroLimits::least times what biases and
/// misalignments of the accelerometers make by the study's own priors, and leaves no more than
/// GimbalZeroLimits::left times of that, and that of no other gimbal does half as well.
std::string gimbal_off_zero(const mc::Study& study, const Recording& recording);

/// Which gimbal turns the other way than its readings, told by the same comparison where its angles
/// are too small for the attitudes of the plan to show it; with the line to write. Empty where none
/// does, or where reversing one leaves more than GimbalZeroLimits::left of what the study's priors
/// make, or another one does nearly as well.
std::string gimbal_of_wrong_sign(const mc::Study& study, const Recording& recording);

}  // namespace drift::preparation
