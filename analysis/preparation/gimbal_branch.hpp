#pragma once

#include <string>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// Turns rows in which the middle gimbal reads more than 90 deg from its zero into the same
/// attitude by the other angles that a chain of three gimbals has for it, outer + 180 deg, 180 deg
/// - middle, inner + 180 deg: those are what the model predicts. Rows that lack one of the three
/// stay. To be done when the columns are known to be those they are called: one that stands in the
/// place of the middle gimbal is exchanged only as it was read.
///
/// An error of the middle gimbal's zero changes sign with the branch, one of the others' does not.
/// A recording in which a gimbal reads more than a turn is left as it is.
void take_usual_branch(Recording& recording);

/// In how many rows that will be done, in words; empty if in none.
std::string other_branch(const Recording& recording);

}  // namespace drift::preparation
