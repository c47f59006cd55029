#pragma once

#include "core/base/linalg.hpp"
#include "core/physics/triads.hpp"

namespace drift {

/// What a term may see: the platform at one instant. Platform axes throughout.
template <class S>
struct Inputs {
  const Mounting* mounting = nullptr;
  Vec3T<S> f_p;          ///< specific force [g]
  Vec3T<S> omega_ic_p;   ///< inertial rate of the case [rad/s]
  Vec3 omega_cmd_p;      ///< commanded inertial rate of the platform [rad/s]

  Vec3T<S> f_output() const { return mounting->gyro.along_second(f_p); }  ///< along gyro output axes
  Vec3T<S> f_spin() const { return mounting->gyro.along_third(f_p); }     ///< along gyro spin axes
};

/// The slots of eqs. (1) to (6) that a term may add to.
template <class S>
struct RateAssembly {
  Mat3T<S> E_gp = Mat3T<S>::Zero();           ///< C_gp - I: misalignment of the input axes [rad]
  Vec3T<S> omega_drift_g = Vec3T<S>::Zero();  ///< w_l, internal drift of each gyro [rad/s]
  Vec3T<S> omega_torque_g = Vec3T<S>::Zero(); ///< w_md, torquer-equivalent rate [rad/s]
  S lambda = S(0.0);                          ///< weight of eq. (6) in the lambda family
};

/// The slots of the readout.
template <class S>
struct ReadoutAssembly {
  Vec3T<S> acc;  ///< accelerometer outputs [g]; starts as the specific force
};

}  // namespace drift
