#pragma once

#include "core/recording/recording.hpp"

namespace drift {

/// Rows that are evenly spaced, with times that were written in steps too coarse to show it (hours
/// with two decimals, one row a minute: 72, 36, 72, 72 s; hours and minutes, two rows a minute: 0,
/// 60, 0, 60 s, where they are not one row that was written twice), get the times that they have:
/// those of the roundest distance at which even rows would be written as they are, in the whole log
/// or, where that goes on otherwise between positions, in each of them. A remark says which others
/// would be. Any other recording is left as it is; so is one of which rows may be lost instead,
/// where few distances are twice the others or no round distance will do.
void take_even_times(Recording& recording);

}  // namespace drift
