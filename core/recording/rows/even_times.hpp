#pragma once

#include "core/recording/recording.hpp"

namespace drift {

/// Rows that are evenly spaced, with times that were written in steps too coarse to show it (hours
/// with two decimals, one row a minute: 72, 36, 72, 72 s; hours and minutes, two rows a minute: 0,
/// 60, 0, 60 s, where they are not one row that was written twice), get the times that they have:
/// in every position those of the even spacing that stays within one step of all that is written. A
/// remark says so. Any other recording is left as it is; so is one of which rows may be lost
/// instead, where few distances are twice the others.
void take_even_times(Recording& recording);

}  // namespace drift
