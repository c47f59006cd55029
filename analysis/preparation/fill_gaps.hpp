#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// Puts rows without measurements where rows are missing within a dwell or a slew, so that the
/// attitude can be carried along: evenly spaced, commands held, case heading and covariates on a
/// straight line. Only where position, phase and commands are the same before and after; other gaps
/// are left for the layout to complain of. interval: of the samples [s]. Says what was done.
void fill_gaps(Recording& recording, double interval, std::vector<std::string>& remarks);

}  // namespace drift::preparation
