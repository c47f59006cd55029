#pragma once

#include <cstdint>
#include <vector>

#include "core/estimate/batch.hpp"
#include "core/sim/memory_left_out.hpp"
#include "core/sim/memory_over_gaps.hpp"
#include "mc/study/study.hpp"

namespace drift::identification {

/// The terms of a filter whose memory is wrong by more than goes without saying
/// (RemarkLimits::memory): it follows the nominal path of the test, and the platform takes another,
/// that of the fit.
std::vector<MemoryLeftOut> memory_doubt(const FilterSpec& filter, const BatchResult& fit,
                                        const Timeline& timeline);

/// The same of the truth of a study, along the path of a simulated run, without the noise that
/// drives it; a servo as the equation that it settles to. Empty without the truth of a
/// platform.
std::vector<MemoryLeftOut> memory_doubt(const mc::Study& study, std::uint64_t run);

/// The gaps of a test over which one term's memory is not known: in front of how many positions,
/// and the one that leaves most open.
struct MemoryGaps {
  MemoryOverGap widest;
  std::size_t count = 0;
};

/// Terms of a filter whose memory hangs on when, in a gap, the platform was turned: that is not
/// recorded, and the begin of the gap is assumed (MemoryPath). Amplitudes would be wrong by more
/// than RemarkLimits::memory of themselves, were it the end.
std::vector<MemoryGaps> memory_gaps(const FilterSpec& filter, const BatchResult& fit,
                                    const Timeline& timeline);

}  // namespace drift::identification
