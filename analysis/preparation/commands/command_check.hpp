#pragma once

#include <string>
#include <vector>

#include "analysis/preparation/dwell_turn.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// The commands recorded in dwells against those of the plan's law.
///
/// Remarked, and the recorded ones are used: commands of the other law, of another latitude (one
/// that all level dwells show), of neither, and commands that are a constant factor times the
/// plan's beyond the prior of the torquers' scale. Refused (a message in `wrong`), where the
/// platform stands though the recorded commands would turn it: columns that are exchanged or
/// reversed, with the line of the study that mends them, and such a factor where it makes more than
/// PlanLimits::command_deg_per_h, with the unit that it is of.
void check_commands(const mc::Study& study, const Recording& recording, const Timeline& timeline,
                    const Measurements& measured, const std::vector<Dwell>& dwells,
                    std::vector<std::string>& remarks, std::vector<std::string>& wrong);

}  // namespace drift::preparation
