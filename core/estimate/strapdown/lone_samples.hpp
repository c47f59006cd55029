#pragma once

#include <vector>

#include "core/estimate/strapdown/signals.hpp"

namespace drift::strapdown {

/// A sample of a gyro that lies off the cubic through the two before and the two after it, alone: a
/// motion goes on for more than one sample, and a knock rings.
struct LoneSample {
  std::size_t sample = 0;
  int axis = 0;
  double off = 0.0;    ///< [rad/s]
  double turns = 0.0;  ///< what it turns the attitude by: off times the sample's length [rad]
};

/// Those of a recording, by time. A sample is one where chance has it with 1e-3 in the whole
/// recording: its distance over that of the 40 samples before or after, whichever is larger, as
/// Student's t, and what the five samples leave beside it as Fisher's F. Nothing is said of a
/// sample near a gap, near an end, or within two steps of the readout.
std::vector<LoneSample> lone_gyro_samples(const Signals& signals);

}  // namespace drift::strapdown
