#pragma once

#include <vector>

#include "analysis/observability/information.hpp"

namespace drift::observability {

/// Learning ratios (posterior over prior sigma) of every state, layout order, where the truth is
/// model.nominal: by the information there. Where lambda is a state the cost has a bent valley
/// whose curvature at one point says too much: by lambda's whole posterior (over_closure()) after a
/// test without noise; not where a drift walks, which no batch fit knows. InputError (self_check)
/// as linearise().
std::vector<double> learning_at_truth(const TestPlan& plan, const RankedModel& model);

}  // namespace drift::observability
