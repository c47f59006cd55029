#pragma once

#include <array>
#include <optional>

#include "analysis/inference/noise/noise_model.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/measured_test.hpp"

namespace drift::equation {

/// lambda of the family of eq. (5) and (6), with everything else integrated out.
struct ClosureProfile {
  double value = 0.0, sigma = 0.0;
  BatchResult fit;  ///< with lambda held at the value
};

/// How probable values of lambda are.
struct ClosureWeighed {
  /// Twice the log by which lambda = 0 and 1 are less probable than the most probable value tried.
  std::array<double, 2> loss_at_end{};
  std::optional<ClosureProfile> profile;  ///< where that says more than the joint fit
};

/// lambda and the misalignments E are bilinear: a test shows (1 - lambda) E or lambda E. Where the
/// other equation makes one of these vanish, the most probable point of all parameters together has
/// E near zero and any lambda, though nearly all of the probability is at lambda = 1 (or 0) with E
/// as large as its prior allows (physics.md 1.7: use the profile). Here
///
///   p(lambda | y) ~ p(lambda) int p(y | lambda, x) p(x) dx   (Laplace at each lambda)
///
/// is evaluated at both ends and at the joint fit; where an end is more probable than the joint fit
/// by `decisive` (twice the log), between them and around the most probable point too, and mean and
/// sigma are taken from it.
/// Otherwise there is no profile: the joint fit is as good. filter: with lambda free.
ClosureWeighed weigh_closure(const FilterSpec& filter, const MeasuredTest& test,
                             const BatchResult& joint, const VecX& weight,
                             const inference::NoiseModel& noise,
                             double decisive = inference::WeighLimits::valley);

}  // namespace drift::equation
