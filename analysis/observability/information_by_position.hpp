#pragma once

#include "analysis/observability/information.hpp"

namespace drift::observability {

/// Which position, and which minutes, inform each parameter. Gains are log2(sigma before / sigma
/// after) [bit]: over all bins they add up to log2(prior sigma / posterior sigma). Of a drift that
/// walks the sigma is that at the time: where nothing shows it, it is less known by the end.
struct InformationCourse {
  MatX gain;           ///< by bin in order of time, shape (n, bins)
  MatX position_gain;  ///< the same by position, shape (n, positions)
  VecX bits;           ///< gained by all parameters together, log2 det / 2, by position [bit]
  MatX loss;           ///< log2(sigma without what was measured at the position / sigma), shape (n,
                       ///< positions)
};

/// Follows the posterior through a plan in order of time, and leaves out each position in turn.
/// A position that is left out is still passed through: its slew and dwell happen, unmeasured.
InformationCourse information_course(const LinearisedPlan& plan);

}  // namespace drift::observability
