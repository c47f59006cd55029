#pragma once

#include <string>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/inference/thresholds.hpp"

namespace drift::report {

/// Prior sigmas above which a size is unusual: 1 in a million units has it.
inline constexpr double unusual_size = inference::FitLimits::beyond_prior;

/// Candidates that would explain a recording as the causes do: " What would explain it as well, but
/// loses by its size alone: base_motion_leak.y (12 times its usual size)." Of a term the
/// likeliest; empty without one, or where nothing is missing.
std::string too_large_text(const diagnosis::Diagnosis& diagnosis);

/// Whether what comes nearest to the causes, were every size as usual, is such a candidate.
bool nearest_is_too_large(const diagnosis::Diagnosis& diagnosis);

}  // namespace drift::report
