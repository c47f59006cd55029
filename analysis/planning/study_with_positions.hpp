#pragma once

#include <string>
#include <vector>

#include "mc/study/study.hpp"

namespace drift::planning {

/// The study file (study.text, what --set changed included) with these positions for its plan,
/// written out one by one. Order and values of the rest are kept, comments are not, nor the lines
/// of [sweep] in swept_of_plan().
std::string study_with_positions(const mc::Study& study, const std::vector<Position>& positions);

/// The study file with positions added behind its plan; a preset is written out position by
/// position. InputError (config) if the plan has no positions (strapdown).
std::string extended_study(const mc::Study& study, const std::vector<Position>& positions);

/// Keys of the lines of [sweep] that mean nothing where positions are written out: a preset is
/// refused beside them, a dwell of [plan] changes none that has its own, and a list of positions
/// takes the place of all.
std::vector<std::string> swept_of_plan(const mc::Study& study);

}  // namespace drift::planning
