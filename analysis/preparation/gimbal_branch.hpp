#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// Rows in which the middle gimbal reads more than 90 deg from its zero are turned into the same
/// attitude by the other angles that a chain of three gimbals has for it, outer + 180 deg,
/// 180 deg - middle, inner + 180 deg: those are what the model predicts. Rows that lack one of the
/// three stay. A remark says how many were turned.
///
/// An error of the middle gimbal's zero changes sign with the branch, one of the others' does not.
/// A recording in which a gimbal reads more than a turn is left as it is.
void take_usual_branch(Recording& recording, std::vector<std::string>& remarks);

}  // namespace drift::preparation
