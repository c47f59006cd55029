#pragma once

#include <vector>

#include "core/recording/recording.hpp"

namespace drift {

/// Leaves out the rows that are marked, one mark for each.
void leave_out_rows(Recording& recording, const std::vector<bool>& out);

/// Rows of a platform's recording that are of no position, as its column of positions says (0, a
/// number below, an empty cell), while it is turned from one position to the next. Those turned by
/// commands, or slews by `phase`, are slews to the next position, and what stands before and behind
/// them is of its neighbour; others are left out, and so are rows before the first position and
/// behind the last one. A remark says how many.
///
/// Nothing is done where rows of 0 and below lie before the first position or behind the last one
/// alone (they may be counted from 0), where such a row lies within a position, or where a position
/// has fewer rows than CountLimits::fewest_rows: then its number may be written where it changes
/// alone.
void take_turned_rows(Recording& recording);

}  // namespace drift
