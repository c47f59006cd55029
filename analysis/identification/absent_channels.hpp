#pragma once

#include <string>
#include <vector>

#include "core/plan/readout.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::identification {

/// Channels that [readout] reads and that show nothing in any of the recordings (made ready).
std::vector<std::string> absent_channels(const std::vector<Recording>& recordings,
                                         const Readout& readout);

/// Whether all three of an instrument are among them.
bool lacks(const std::vector<std::string>& absent, const ChannelTriple& instrument);

}  // namespace drift::identification
