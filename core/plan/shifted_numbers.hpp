#pragma once

#include <string>

#include "core/plan/test_plan.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// Whether the numbers of the positions change rows too early or too late: in three positions or
/// more the platform, caged at the begin of the next, jumps by more than a plan may be missed
/// (largest_mismatch) the same number of rows, two or more, before the last row or behind the
/// first, and in none another number. Or it jumps so before the last rows of three positions or
/// more, whose numbers may differ where it is turned there; or of fewer, if it does not jump where
/// the number changes. Which, and what to do; empty otherwise. One row is told by what it does to
/// the readings there. r: rows as the file has them.
std::string shifted_numbers(const Recording& r, const TestPlan& plan);

}  // namespace drift
