#pragma once

#include <vector>

#include "core/estimate/batch.hpp"

namespace drift::identification {

/// A sample far from its neighbours.
struct Spike {
  int channel = 0;   ///< 0..2 accelerometers x y z, 3..5 gimbals outer middle inner
  double t = 0.0;    ///< of its row [s]
  int position = 1;  ///< number of the plan's position, from 1
};

/// Isolated samples far from their neighbours, taken out of the measurements: a sample is compared
/// with the median of the four around it in its channel and position (at its ends: of the four
/// beside it; what stands out at the beginning of several dwells is no lone sample). Where the
/// instrument is noisier than declared (by more than the gate allows for), its own noise is the
/// measure.
struct Despiked {
  Measurements measured;      ///< with those samples not measured
  std::vector<Spike> spikes;  ///< those samples
};
Despiked without_spikes(Measurements measured, const Timeline& timeline, const Readout& readout,
                        const BatchResult& fit);

}  // namespace drift::identification
