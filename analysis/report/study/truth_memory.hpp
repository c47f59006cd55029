#pragma once

#include <cstdint>
#include <string>

#include "mc/study/study.hpp"

namespace drift::report {

/// A note for the terminal, a line, where terms of [truth] remember another path than the platform
/// of a run takes (memory_doubt()); empty elsewhere.
std::string truth_memory_text(const mc::Study& study, std::uint64_t run);

}  // namespace drift::report
