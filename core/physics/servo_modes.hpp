#pragma once

#include <cmath>
#include <complex>
#include <limits>

#include "core/physics/servo_options.hpp"

namespace drift {

/// What a small disturbance of the loop at rest becomes.
struct ServoModes {
  std::complex<double> slowest;  ///< the mode that grows fastest, else that dies out last [1/s]
  double rounding = 0.0;         ///< of its real part [1/s]

  bool grows() const { return slowest.real() > rounding; }
  /// In which it grows, or dies out, by a factor e [s]; infinite of one that does neither.
  double time() const {
    const double rate = std::abs(slowest.real());
    return rate > rounding ? 1.0 / rate : std::numeric_limits<double>::infinity();
  }
};

/// Modes of the loop at rest: eigenvalues of the Jacobian of servo_derivative(), without gyro
/// errors and without Coulomb friction, which holds a loop only as long as nothing turns. The
/// attitude, which the loop does not close over, is none of them.
///
/// In the axes of its eigenvectors, D leaves loops that stand alone, each with the gain mu K: a
/// complex mu is a pair of axes that turn into each other. So are axes whose gyros are turned by
/// `turned` [rad] against the motors, D (I + E) for D, which damps one of the two modes less.
/// For floats of FloatDynamics::single_axis. Source: physics.md 1.5, modes of the default in 6.2.
ServoModes servo_modes(const ServoOptions& servo, double turned = 0.0);

}  // namespace drift
