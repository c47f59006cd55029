#pragma once

#include <limits>

#include "analysis/inference/equation.hpp"
#include "core/base/linalg.hpp"

namespace drift::inference {

/// Something unknown, of free form, in one equation alone: a first-order Markov process; with
/// infinite tau a random walk from zero, with `constant` a value that holds for a whole recording.
struct LoneInput {
  /// So much longer than any recording that exp(-t / tau) is 1.
  static constexpr double constant = std::numeric_limits<double>::max();
  Equation equation = Equation::rate;  ///< gyro drift, error of an accelerometer, of a resolver
  int axis = 0;
  double sigma =
      0.0;  ///< stationary [rad/s, g, rad]; of a random walk per sqrt(s). 0: there is none
  double tau = std::numeric_limits<double>::infinity();  ///< [s]
  bool operator==(const LoneInput&) const = default;
};

/// Standard deviations of all noise: white of the instruments, and what drives the platform.
struct NoiseModel {
  double acc_factor = 1.0, gimbal_factor = 1.0;  ///< white, over declared
  double angle_random_walk = 0.0;                ///< [rad/sqrt(s)]
  double drift_random_walk = 0.0;                ///< [rad/s/sqrt(s)]
  double markov_drift = 0.0;                     ///< stationary sigma of a gyro's drift [rad/s]
  double markov_tau = 1800.0;                    ///< [s]
  double caging_drift = 0.0;  ///< of what each caging adds to a gyro's drift, anew [rad/s]
  double acc_markov = 0.0;    ///< stationary sigma of correlated accelerometer noise [g]
  double acc_tau = 300.0;     ///< [s]
  Vec3 gyros = Vec3::Ones();  ///< weight of each gyro's share in what drives the platform
  LoneInput lone;             ///< beside what the instruments share

  bool driven() const {
    return angle_random_walk > 0.0 || drift_random_walk > 0.0 || markov_drift > 0.0 ||
           caging_drift > 0.0 || acc_markov > 0.0 || lone.sigma > 0.0;
  }
  bool operator==(const NoiseModel&) const = default;
};

}  // namespace drift::inference
