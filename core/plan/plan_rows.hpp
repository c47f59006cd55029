#pragma once

#include <string>
#include <vector>

#include "core/plan/test_plan.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// The position of the plan that a recording calls by this number, from 1 on; null: the plan has
/// none.
const Position* planned_position(const TestPlan& plan, double number);

/// The plan's sample at each row of a recording [s]; in a position that the plan does not have
/// (lay_out() refuses it), or of a recording that names none, that of the first.
std::vector<double> planned_samples(const Recording& recording, const TestPlan& plan);

/// Where a position has more or fewer rows in its dwell than the plan would give, in words: one
/// remark, or none. It is allowed; the recording's own rows are used, and each counts as one
/// measurement with the noise of [readout].
std::vector<std::string> rows_other_than_planned(const Recording& recording, const TestPlan& plan);

/// Where the dwells of some positions have rows that are evenly two or more times as far apart as
/// those of the others (of more than half, or as planned), and the plan has them no longer: means
/// over that, or every other row is lost. In words, with what to do if it is; or empty.
std::string rows_longer_than_others(const Recording& recording, const TestPlan& plan);

}  // namespace drift
