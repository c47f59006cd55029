#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// Whether a recording can be of the study's plan, as far as its own columns tell. It fits the plan
/// in positions, sample interval and attitudes (lay_out() and prepare() have looked).
///
/// Remarked, and the recording's own times and commands are used: dwells longer or shorter than the
/// plan's. Commands that are not those of the plan's law are remarked or refused
/// (check_commands()). Refused (a message in `wrong`): a recording without commands in which the
/// platform turns against the local axes as under the other law: free drift at Earth rate, level
/// not at all. That is asked of the mean over the positions of a law, where drift of a few deg/h in
/// each averages out; it must be within 0.4 of Earth rate of the other law. Read off the gimbals,
/// or off Up as the accelerometers see it.
void check_plan(const mc::Study& study, const Recording& recording,
                std::vector<std::string>& remarks, std::vector<std::string>& wrong);

}  // namespace drift::preparation
