#pragma once

#include "core/estimate/batch.hpp"

namespace drift::diagnosis {

/// Isolated samples far from their neighbours, taken out of the measurements: a sample is compared
/// with the median of the four around it in its channel and position. Where the instrument is
/// noisier than declared (by more than the gate allows for), its own noise is the measure.
struct Despiked {
  Measurements measured;    ///< with those samples not measured
  std::size_t removed = 0;  ///< how many
};
Despiked without_spikes(Measurements measured, const Timeline& timeline, const Readout& readout,
                        const BatchResult& fit);

}  // namespace drift::diagnosis
