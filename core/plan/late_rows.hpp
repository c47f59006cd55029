#pragma once

#include <vector>

#include "core/plan/attitude_slips.hpp"
#include "core/recording/recording.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {

/// How far an attitude is from the plan's as a kind of instrument sees it [rad].
using Mismatch = double (*)(const Sight&, const Vec3& seen);

/// Columns that stand a row late: the fewest of three that, in the first row of every position that
/// is elsewhere, read what the row before reads rather than what the row behind does, and with
/// whose readings of the row behind it shows the attitude of the plan. By numbers, from 0; none if
/// no such columns do, or where fewer than three positions are elsewhere.
/// wrong: the first rows of positions that are elsewhere.
std::vector<std::size_t> late_columns(const Recording& recording, const std::vector<Sight>& wrong,
                                      const ChannelTriple& channels, Mismatch mismatch);

/// How many rows at most stand in these positions before one that shows the attitude of the plan,
/// and is less than half as far from it, in the first quarter of each: rows on the way, or of the
/// position before. 0 where one of the positions does not come there so.
std::size_t rows_on_the_way(const Recording& recording, const std::vector<Sight>& wrong,
                            const ChannelTriple& channels, Mismatch mismatch);

/// Whether all columns do, and the heading of the case as well: the number of the position changes
/// a row early.
bool numbers_early(const Recording& recording, const std::vector<Sight>& wrong,
                   const ChannelTriple& channels, Mismatch mismatch);

}  // namespace drift
