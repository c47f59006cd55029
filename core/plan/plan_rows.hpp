#pragma once

#include <string>
#include <vector>

#include "core/plan/test_plan.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// Where a position has more or fewer rows in its dwell than the plan would give, in words: one
/// remark, or none. It is allowed; the recording's own rows are used, and each counts as one
/// measurement with the noise of [readout].
std::vector<std::string> rows_other_than_planned(const Recording& recording, const TestPlan& plan);

}  // namespace drift
