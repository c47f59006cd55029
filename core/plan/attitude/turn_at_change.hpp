#pragma once

#include <cstddef>
#include <optional>

#include "core/recording/recording.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {

/// Rows that follow each other under one number of a position.
struct RowStretch {
  std::size_t first = 0, end = 0;  ///< the end is the first row of the next

  std::size_t rows() const { return end - first; }
};

/// Where a platform turns from one attitude to the next: at the end of the row before `first` it
/// still stands in the one, at the end of `last` in the other. They are one row where it jumps.
struct SeenTurn {
  std::size_t first = 0, last = 0;
};

/// The turn that gimbals, or accelerometers by their Up, show around where the number of the
/// position changes, in the last quarter of the rows before and the first quarter of those behind:
/// all motion there, of angles and of the attitude, that is faster than that of the dwells, by more
/// than a plan may be missed (largest_mismatch) from its begin to its end, and a reading that is
/// none turns back. Empty where there is none, or where the dwells move as fast.
std::optional<SeenTurn> turn_at_change(const Recording& recording, const ChannelTriple& channels,
                                       const RowStretch& before, const RowStretch& behind);

}  // namespace drift
