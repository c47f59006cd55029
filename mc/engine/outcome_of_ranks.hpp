#pragma once

#include "mc/engine/engine.hpp"
#include "mc/engine/mpi_launch.hpp"

namespace drift::mc {

/// How the session ended is what the leader found. All ranks come here.
void share_with_all(StudyOutcome& outcome, Ranks& ranks);

}  // namespace drift::mc
