#pragma once

#include "analysis/search/fitted.hpp"

namespace drift::search {

/// Looks between the points of the library's grids: candidates whose log evidence is within `worth`
/// of the best one get further settings on either side of their best settings (three between each
/// two points), their signatures are computed and everything is scored again. A step at 3.5 h
/// leaves a trace that steps at 3 and 4 h together do not explain, and something else would be
/// called for beside it.
Fitted refine_grids(Fitted e, const MeasuredTest& test, double worth);

/// The same between all points, of all candidates: a step between two points that are further apart
/// than the positions of a plan is at neither of them, and another setting scores best. Variants
/// are numbered anew by that.
Fitted refine_whole_grids(Fitted e, const MeasuredTest& test);

/// The number of the variant with these settings, which there is.
std::size_t variant_at(const inference::Candidate& candidate, const inference::Settings& settings);

}  // namespace drift::search
