#pragma once

#include "analysis/blind/session/answer_trials.hpp"

namespace drift::blind {

/// The diagnosis of `driftscope diagnose`, without what is not scored (start spread, recovered
/// signal).
Solver diagnosing_solver();

}  // namespace drift::blind
