#pragma once

#include <string>

#include "core/plan/test_plan.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// Whether readings and numbers of positions are of one instant in a row, and rows of a position
/// alone, as turns show between caged positions that no command makes (turn_at_change()). Which is
/// not, and what to do; empty otherwise:
///
/// Gimbals and accelerometers turn two rows or more from each other, the same in three positions or
/// more and in none by another number: those that do not turn with the numbers stand so many rows
/// late, or early; either may where both, or neither, do.
///
/// Else the numbers change too early or too late: in three positions or more the platform jumps the
/// same number of rows, two or more, before the last row or behind the first, and in none another
/// number. Or rows on the way carry the number of a position: the platform turns before the last
/// rows of three positions or more, or up to rows behind the first, whose numbers may differ; or
/// it jumps before the last rows of fewer, if not where the number changes.
///
/// One row is told by what it does to the readings there. r: rows as the file has them.
std::string shifted_numbers(const Recording& r, const TestPlan& plan);

/// The same where no plan says which positions are caged: all that no command turns.
std::string shifted_numbers(const Recording& r);

}  // namespace drift
