#pragma once

#include <Eigen/Core>

#include "core/base/linalg.hpp"

namespace drift {

/// What a float feels besides the rate about its input axis (physics.md 1.5).
enum class FloatDynamics {
  single_axis,  ///< nothing
  coupled,      ///< output-axis acceleration -J_f (w_ip' . O) and cross-coupling H theta (w_ip . S)
};

/// The null-seeking loop of physics.md 1.5: three floats, compensator, motors, stable element.
///
/// Defaults are a medium floated platform whose loop crosses unit gain at 20 Hz and whose modes
/// (-1e4, -333, -104, -58 1/s) are those of physics.md 6.2.
struct ServoOptions {
  double wheel_momentum =
      0.02;  ///< H [N m s]; physics.md 1.5: kappa = 0.99975 at k_f 0.1, K 20, b 1e-3
  double float_inertia =
      2e-6;  ///< J_f about the output axis [kg m^2]; c/J_f = 1e4 1/s, physics.md 6.2
  double float_damping = 0.02;   ///< c [N m s/rad]; c = H makes theta the integral of the rate, 1.5
  double float_restraint = 0.0;  ///< k_f [N m/rad]; 0 is a true integrating gyro, 1.5
  double platform_inertia = 0.05;  ///< J_p [kg m^2]; with K, T1, T2 from the modes of 6.2
  double loop_gain = 200.0;  ///< K [N m/rad]; 1.5: 1e-2 N m hang the platform off by 10.3 arcsec
  double lead = 0.03;        ///< T1 of (1 + T1 s)/(1 + T2 s) [s]; from the modes of 6.2
  double lag = 0.002;        ///< T2 [s], > 0; from the modes of 6.2
  double viscous = 1e-3;     ///< b, gimbal friction on w_ip - w_ic [N m s/rad]; 1.5
  double coulomb =
      0.0;  ///< T_c, smooth Coulomb friction of the gimbals [N m]; off: opt-in effect 26
  double coulomb_rate = 1e-5;  ///< rate at which it saturates [rad/s]; a seventh of Earth rate
  Vec3 constant_torque = Vec3::Zero();  ///< T_0, flex leads: hang-off T_0/K of the float [N m]; 1.5
  Mat3 motor_coupling = Mat3::Identity();  ///< D, decoupling matrix of the motors; 1.5
  FloatDynamics float_dynamics = FloatDynamics::single_axis;  ///< what else 1.5 writes down
  double base_amplitude = 0.0;  ///< angular base motion of the case about each axis [rad]; off
  double base_frequency = 0.0;  ///< of the base motion [Hz]; off
};

}  // namespace drift
