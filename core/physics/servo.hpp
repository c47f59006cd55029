#pragma once

#include <Eigen/LU>

#include "core/physics/drift_model.hpp"
#include "core/physics/servo_options.hpp"

namespace drift {

/// Where each quantity sits in the 12 states of the loop; three numbers each.
struct ServoState {
  static constexpr int theta = 0;        ///< float angles about the output axes [rad]
  static constexpr int theta_dot = 3;    ///< [rad/s]
  static constexpr int compensator = 6;  ///< theta behind the lag 1/(1 + T2 s) [rad]
  static constexpr int omega_ip = 9;     ///< inertial rate of the platform, platform axes [rad/s]
  static constexpr int size = 12;
};

/// Torque of the motors about the platform axes [N m], shape 3: T = -D K (1 + T1 s)/(1 + T2 s)
/// theta.
template <class S>
Vec3T<S> motor_torque(const ServoOptions& servo, const S* x) {
  const Vec3T<S> theta = vec3(x + ServoState::theta), lagged = vec3(x + ServoState::compensator);
  const double r = servo.lead / servo.lag;
  return -servo.loop_gain * (servo.motor_coupling * (r * theta + (1.0 - r) * lagged));
}

/// Torque of the gimbals on the platform [N m], shape 3: viscous, smooth Coulomb, constant.
template <class S>
Vec3T<S> gimbal_torque(const ServoOptions& servo, const Vec3T<S>& omega_cp_p) {
  using std::tanh;
  Vec3T<S> torque = servo.constant_torque - servo.viscous * omega_cp_p;
  if (servo.coulomb != 0.0)
    for (int i = 0; i < 3; ++i)
      torque[i] -= servo.coulomb * tanh(omega_cp_p[i] / servo.coulomb_rate);
  return torque;
}

/// Writes d/dt of the 12 states of the null-seeking loop, and returns what moves the platform apart
/// from it, the slot omega_ip_p of RateAssembly [rad/s]:
///
///   J_f theta'' + c theta' + k_f theta = H (C w_ip + w_l + w_md) [- J_f w_ip' . O + H theta w_ip .
///   S] T2 z' = theta - z,     T = -D K (theta + T1 z' - T2 z') = -D K G(s) theta J_p w_ip' = T - b
///   (w_ip - w_ic) - T_c tanh((w_ip - w_ic) / w_s) + T_0
///
/// the bracket with FloatDynamics::coupled. The attitude is the caller's: it enters through in.f_p
/// and in.omega_ic_p (rate of the case, base motion included) and follows x + ServoState::omega_ip.
/// theta_params: every parameter of TermLibrary in SI; the model's coupling is not used, the loop
/// closes by itself. x, x_dot: shape ServoState::size. Stiff: the fastest mode is c/J_f.
/// Source: physics.md 1.5.
template <class S>
Vec3T<S> servo_derivative(const ServoOptions& servo, const DriftModel& model, const Inputs<S>& in,
                          const S* theta_params, const S* x, S* x_dot) {
  const Vec3T<S> theta = vec3(x + ServoState::theta), theta_dot = vec3(x + ServoState::theta_dot);
  const Vec3T<S> lagged = vec3(x + ServoState::compensator),
                 omega_ip_p = vec3(x + ServoState::omega_ip);

  const Vec3T<S> omega_cp_p = omega_ip_p - in.omega_ic_p;
  const Vec3T<S> omega_ip_dot =
      (motor_torque(servo, x) + gimbal_torque(servo, omega_cp_p)) / servo.platform_inertia;

  const RateAssembly<S> a = assemble(model, in, theta_params);
  const Vec3T<S> felt = omega_ip_p + a.E_gp * omega_ip_p + a.omega_drift_g + a.omega_torque_g;
  Vec3T<S> float_torque =
      servo.wheel_momentum * felt - servo.float_damping * theta_dot - servo.float_restraint * theta;
  if (servo.float_dynamics == FloatDynamics::coupled) {
    const Triads& gyro = in.mounting->gyro;
    float_torque += servo.wheel_momentum * theta.cwiseProduct(gyro.along_third(omega_ip_p)) -
                    servo.float_inertia * gyro.along_second(omega_ip_dot);
  }
  for (int i = 0; i < 3; ++i) {
    x_dot[ServoState::theta + i] = theta_dot[i];
    x_dot[ServoState::theta_dot + i] = float_torque[i] / servo.float_inertia;
    x_dot[ServoState::compensator + i] = (theta[i] - lagged[i]) / servo.lag;
    x_dot[ServoState::omega_ip + i] = omega_ip_dot[i];
  }
  return a.omega_ip_p;
}

/// The states at which the loop rests under constant inputs, shape ServoState::size; a start from
/// here has next to no transient. Exact for single_axis floats, and with Coulomb friction when
/// k_f = 0; otherwise the friction is that of the answer after three substitutions.
///
///   (C + beta D^-1) w_ip = -u + k_f/(H K) D^-1 (T_0 + T_friction + b w_ic),  beta = b k_f/(H K)
///   theta = D^-1 (T_0 + T_friction - b (w_ip - w_ic)) / K
///
/// which is eq. (6), w_ip = -C^-1 u, for k_f = 0, whatever K, b and D. Source: physics.md 1.5.
inline Eigen::Matrix<double, ServoState::size, 1> servo_at_rest(const ServoOptions& servo,
                                                                const DriftModel& model,
                                                                const Inputs<double>& in,
                                                                const double* theta_params) {
  const RateAssembly<double> a = assemble(model, in, theta_params);
  const Mat3 D_inverse = servo.motor_coupling.inverse();
  const double leak = servo.float_restraint / (servo.wheel_momentum * servo.loop_gain);
  const Mat3 closed = Mat3::Identity() + a.E_gp + leak * servo.viscous * D_inverse;
  const Vec3 u = a.omega_drift_g + a.omega_torque_g;

  Vec3 torque = servo.constant_torque, omega_ip_p = in.omega_ic_p;
  for (int pass = 0; pass < 3; ++pass) {
    omega_ip_p =
        closed.inverse() * (leak * (D_inverse * (torque + servo.viscous * in.omega_ic_p)) - u);
    const Vec3 omega_cp_p = omega_ip_p - in.omega_ic_p;
    torque = gimbal_torque(servo, omega_cp_p) + servo.viscous * omega_cp_p;
  }
  const Vec3 theta =
      D_inverse * (torque - servo.viscous * (omega_ip_p - in.omega_ic_p)) / servo.loop_gain;
  Eigen::Matrix<double, ServoState::size, 1> x;
  x << theta, Vec3::Zero(), theta, omega_ip_p;
  return x;
}

}  // namespace drift
