#pragma once

#include <vector>

#include "core/estimate/batch.hpp"
#include "core/estimate/strapdown/case_test.hpp"

namespace drift::strapdown {

/// Errors of a fitted model.
struct CaseErrors {
  std::vector<double> up;  ///< of each way without a gap: angle of up after it [rad]
  std::vector<double>
      gyro;  ///< of each dwell: root mean square over the gyros [rad/s]; NaN: no rest
  std::vector<double> gravity;  ///< of each dwell: | |f| - 1 | [g]
};

/// What a model makes of a test. Up after a way: the attitude before it is levelled by the
/// accelerometers of the dwell before, and carried along by the readings. A dwell's numbers are
/// those of the means over its rows; where it is no rest to the gyros, up is what its outer rows
/// have.
CaseErrors case_errors(const CaseTest& test, const DriftModel& model, const Theta& theta,
                       const std::vector<Vec3>& psi0_l);

}  // namespace drift::strapdown
