#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/physics/drift_model.hpp"
#include "core/plan/timeline.hpp"

namespace drift {

/// What is not recorded between two positions, where a term remembers in which attitude it was
/// spent.
struct MemoryOverGap {
  std::string_view term;
  int from = 0, to = 0;  ///< positions before and after it, from 0
  double length = 0.0;   ///< [s]
  /// Of what the new attitude has yet to settle where the platform was turned at the end of the
  /// gap, the part that is left where it was turned at its begin: exp(-length / tau) of a memory
  /// that lags by tau. A trace that is of the former has amplitudes that are by this factor smaller
  /// than those that MemoryPath, which turns it at the begin, makes of it.
  double left = 1.0;
  std::size_t recording = 1;  ///< number of the one that it is in, from 1
};

/// The gaps in front of caged positions of a platform over which terms of a model remember
/// attitude and that change it by more than a little (0.1 g), for each term with memory, in the
/// order of the library. theta: SI.
std::vector<MemoryOverGap> memory_over_gaps(const Timeline& timeline, const DriftModel& model,
                                            const Theta& theta);

}  // namespace drift
