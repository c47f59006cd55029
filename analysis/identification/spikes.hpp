#pragma once

#include <cstddef>
#include <vector>

#include "core/estimate/batch.hpp"

namespace drift::identification {

/// A sample far from its neighbours.
struct Spike {
  int channel = 0;             ///< 0..2 accelerometers x y z, 3..5 gimbals outer middle inner
  double t = 0.0;              ///< of its row, by the clock of its recording [s]
  int position = 1;            ///< number of the plan's position, from 1
  bool ends_position = false;  ///< its row is the last before the next position
  std::size_t recording = 1;   ///< its number, from 1
};

/// Isolated samples far from their neighbours, taken out of the measurements: a sample is compared
/// with the median of the four around it in its channel: of a dwell within the dwell (at its ends:
/// with the four beside it; what stands out at the beginning of several dwells is no lone sample),
/// of a slew with two rows before and two after, on whichever side of its ends: a motion that the
/// model lacks goes on there, and five rows of it stay within what their range allows for. Of two
/// rows on either side within a dwell one may be astray itself: two such samples beside each other
/// are both found. Where the instrument is noisier than declared, its own noise is the measure. Of
/// noise and motion alone any sample is taken for isolated with a chance of 1e-4 at most
/// (SampleLimits).
struct Despiked {
  Measurements measured;      ///< with those samples not measured
  std::vector<Spike> spikes;  ///< those samples
};
Despiked without_spikes(Measurements measured, const Timeline& timeline, const Readout& readout,
                        const BatchResult& fit);

/// The positions, of every recording, whose last row is such a sample, if no other rows are and
/// there are so many that no chance has it (SampleLimits::late_positions), as where the numbers of
/// positions change a row too late. 0 otherwise.
std::size_t late_labels(const std::vector<Spike>& spikes);

}  // namespace drift::identification
