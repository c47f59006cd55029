#pragma once

#include <string>
#include <vector>

#include "core/plan/test_plan.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// Where the rows of a recording are others than the plan would give, in words, a remark each:
/// positions with more or fewer rows in their dwell, and positions of the plan that are not there.
/// Both are allowed; the recording's own rows are used, and each counts as one measurement with the
/// noise of [readout].
std::vector<std::string> rows_other_than_planned(const Recording& recording, const TestPlan& plan);

}  // namespace drift
