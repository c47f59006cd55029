#pragma once

#include <vector>

#include "core/base/linalg.hpp"
#include "core/recording/recording.hpp"

namespace drift::strapdown {

/// The samples of a strapdown recording: sensors fixed to the case, as they were read.
struct Signals {
  std::vector<double> time;  ///< end of each sample interval [s]
  std::vector<Vec3> gyro;    ///< gyro outputs w_g [rad/s]; NaN: not measured
  std::vector<Vec3> acc;     ///< accelerometer outputs [g]; NaN: not measured
  double interval = 0.0;     ///< usual sample interval, the median [s]

  std::size_t size() const { return time.size(); }
  bool measured(std::size_t k) const { return gyro[k].allFinite() && acc[k].allFinite(); }
};

/// Takes the channels time, gyro_x..z and acc_x..z of a recording (core/docs/recording.md).
/// InputError (recording) lists every channel that is missing or has another dimension, and time
/// that does not increase.
Signals signals_of(const Recording& recording);

}  // namespace drift::strapdown
