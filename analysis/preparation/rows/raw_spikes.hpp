#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// Single readings of accelerometers and gimbals that are far from those around (RawSpikeLimits),
/// as the file has them: what is joined of rows would hide them, and carry their mean.
struct RawSpikes {
  std::string channel;
  std::vector<std::size_t> rows;  ///< in order
};

/// Those of every channel that has any. A reading is held against two measured before it and two
/// behind it in its position, of rows that are not slewed; so near to an end of it none is looked
/// at, as the platform may turn there. Nothing is said of a channel that stands still mostly, or of
/// which a good part would be taken.
std::vector<RawSpikes> raw_spikes(const Recording& recording);

/// Those of a channel in words: "log.csv: acc_x: 2 isolated readings far from those around (lines
/// 812, 3377)".
std::string raw_spikes_text(const Recording& recording, const RawSpikes& spikes);

/// Takes them out, with a remark for each channel: they become NaN.
void leave_out_raw_spikes(Recording& recording, std::vector<std::string>& remarks);

}  // namespace drift::preparation
