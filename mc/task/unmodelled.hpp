#pragma once

#include <string>
#include <vector>

#include "core/physics/model_spec.hpp"
#include "mc/study/monte_carlo.hpp"

namespace drift::mc {

/// What of a filter an estimator cannot model, one message each: "what is wrong (what is expected).
/// What to do". Its results in a study would be confidently wrong, so a study refuses it.
std::vector<std::string> unmodelled(EstimatorKind estimator, const FilterSpec& filter);

}  // namespace drift::mc
