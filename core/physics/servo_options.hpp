#pragma once

#include <Eigen/Core>

#include "core/base/linalg.hpp"

namespace drift {

/// The null-seeking loop of physics.md 1.5: three floats, compensator, motors, stable element.
/// Defaults are a medium floated platform with a loop of about 20 Hz.
struct ServoOptions {
  double wheel_momentum = 0.02;        ///< H [N m s]
  double float_inertia = 1e-6;         ///< J_f about the output axis [kg m^2]
  double float_damping = 0.02;         ///< c [N m s/rad]; c = H makes theta the integral of the rate
  double float_restraint = 0.0;        ///< k_f [N m/rad]; 0 is a true integrating gyro
  double platform_inertia = 0.2;       ///< J_p [kg m^2]
  double loop_gain = 200.0;            ///< K [N m/rad]
  double lead = 0.02;                  ///< T1 of (1 + T1 s)/(1 + T2 s) [s]
  double lag = 0.002;                  ///< T2 [s]
  double viscous = 1e-3;               ///< b, gimbal friction on w_ip - w_ic [N m s/rad]
  double coulomb = 0.0;                ///< T_c, smooth Coulomb friction of the gimbals [N m]
  double coulomb_rate = 1e-5;          ///< rate at which it saturates [rad/s]
  Vec3 constant_torque = Vec3::Zero(); ///< T_0, flex leads: makes the hang-off T_0/K [N m]
  Mat3 motor_coupling = Mat3::Identity();  ///< D, decoupling matrix of the motors
  double base_amplitude = 0.0;         ///< angular base motion of the case about each axis [rad]
  double base_frequency = 0.0;         ///< of the base motion [Hz]
};

}  // namespace drift
