#pragma once

#include "analysis/observability/ranking.hpp"

namespace drift::observability {

/// What sigma every parameter would have, as part of the one it has, were one thing known twice as
/// well: layout order, 1 where that changes nothing.
struct Drivers {
  VecX accelerometers, gimbals;  ///< their noise halved
  VecX process_noise;            ///< all that drives the platform at random, terms too, halved
  VecX attitude;                 ///< the prior sigma of the attitude at every caging halved
  MatX priors;                   ///< (k, j): of k, the prior sigma of j halved
};

/// plan: `test` under `model`, linearised. With the noise of either instrument, or of what drives
/// the platform, it is linearised again; priors are changed one by one in the posterior, which is
/// exact.
Drivers drivers_of(const LinearisedPlan& plan, const TestPlan& test, const RankedModel& model);

}  // namespace drift::observability
