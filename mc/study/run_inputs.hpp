#pragma once

#include <string>

#include "mc/study/study.hpp"

namespace drift::mc {

/// A digest of what the rows of a study's runs depend on, as it is resolved. Where two are equal,
/// so are the runs; where they differ, the runs mostly do.
///
/// What the file says in other words is one and the same: a group for its members, [plan] for its
/// positions, a preset for positions, 60 s for 1 min. What no run reads is not in it: names and
/// notes, gravity, the noise of what is not read, rates of slews where there is none, settings of
/// another coupling, surroundings that no term follows. Nor is what the points of a sweep share:
/// how many runs there are, their seed.
///
/// Empty of a study that has no runs: of no platform, or without [truth] or filters.
std::string run_inputs(const Study& study);

}  // namespace drift::mc
