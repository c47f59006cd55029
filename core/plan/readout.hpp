#pragma once

#include "core/base/units.hpp"

namespace drift {

/// What is measured, and how well: 1 sigma of one sample, white.
struct Readout {
  bool accelerometers = true;
  bool gimbals = true;
  double accelerometer_noise = 5e-6;                 ///< of the mean over the sample interval [g]
  double gimbal_noise = 5.0 * detail::deg / 3600.0;  ///< per resolver [rad]
  /// The noise is that of rounding to the steps in which a recording is written: known, whatever
  /// the readings look like from row to row.
  bool accelerometers_rounded = false, gimbals_rounded = false;
  /// The noise of the gimbals, and what drives the attitude, allow for something that need not be
  /// as large (the Earth's rate along a North that nobody knows): less of it is no news.
  bool gimbal_noise_at_most = false;
};

}  // namespace drift
