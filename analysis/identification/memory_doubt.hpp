#pragma once

#include <cstdint>
#include <vector>

#include "core/estimate/batch.hpp"
#include "core/sim/memory_left_out.hpp"
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

}  // namespace drift::identification
