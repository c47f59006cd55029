#pragma once

#include "core/base/linalg.hpp"
#include "core/params/covariates.hpp"
#include "core/physics/triads.hpp"

namespace drift {

/// What a term wants to see beyond specific force, case rate and command. It is worked out only
/// where an active term asks for it.
struct Needs {
  bool clock = false;     ///< time, slew flag, heading of the case, Earth rate
  bool attitude = false;  ///< R_lp
  bool gimbals = false;   ///< gimbal angles
  bool memory = false;    ///< states that the past has left; set for terms that declare `memory`
  bool turning = false;   ///< how a case turns while its accelerometers are read
  bool own_rate = false;  ///< of a hook of the gimbals: how the platform turns of itself
  CovariateSet covariates = 0;  ///< what it follows beside the motion; of a vector also R_lp

  constexpr bool any() const {
    return clock || attitude || gimbals || memory || turning || own_rate || covariates != 0;
  }
  constexpr Needs operator|(const Needs& o) const {
    return {clock || o.clock,         attitude || o.attitude, gimbals || o.gimbals,
            memory || o.memory,       turning || o.turning,   own_rate || o.own_rate,
            covariates | o.covariates};
  }
};

/// How a strapdown unit turns while its accelerometers are read: means over a row, case axes, as
/// its own gyros have it.
struct CaseTurn {
  Vec3 rate = Vec3::Zero();  ///< inertial [rad/s]
  /// <w' x> + <(w x)^2>: row k times the place r [m] of accelerometer k is what that reads of the
  /// turn itself [g/m].
  Mat3 arm = Mat3::Zero();
};

/// An instant of the test: all that does not depend on the platform's attitude.
struct Moment {
  double t;                        ///< since the start of the test [s]
  double t_p;                      ///< since the start of the dwell; 0 on the way to it [s]
  bool slew;                       ///< on the way to a position
  double heading;                  ///< of the case [rad]
  Vec3 omega_ie_l;                 ///< rate of the Earth, as the site has it [rad/s]
  Covariates covariates;           ///< numbers as they deviate from the mean of the recording
  Covariates rates;                ///< their change [1/s]
  const CaseTurn* turn = nullptr;  ///< null: the case rests, or its accelerometers are not read

  bool operator==(const Moment&) const = default;
};

/// What `Needs` names, for one attitude. Only what is asked for is filled.
template <class S>
struct Surroundings {
  Moment now;
  Mat3T<S> R_lp;              ///< attitude, v_l = R_lp v_p
  Vec3T<S> gimbal;            ///< outer, middle, inner [rad]
  const S* memory = nullptr;  ///< of all terms of the library
  /// By what the platform turns otherwise than it is told, as the model's own rates have it; zero
  /// but where gimbals are read. No derivative of it is taken: what it multiplies is far shorter
  /// than the time over which the same rates turn the platform [rad/s].
  Vec3 omega_drift_p = Vec3::Zero();
};

/// What a term may see: the platform at one instant. Platform axes throughout.
template <class S>
struct Inputs {
  const Mounting* mounting = nullptr;
  Vec3T<S> f_p;                             ///< specific force [g]
  Vec3T<S> omega_ic_p;                      ///< inertial rate of the case [rad/s]
  Vec3 omega_cmd_p;                         ///< commanded inertial rate of the platform [rad/s]
  const Surroundings<S>* around = nullptr;  ///< not null where an active term needs it

  Vec3T<S> f_output() const {
    return mounting->gyro.along_second(f_p);
  }                                                                    ///< along gyro output axes
  Vec3T<S> f_spin() const { return mounting->gyro.along_third(f_p); }  ///< along gyro spin axes
  const Moment& now() const { return around->now; }
  /// Of a covariate that is a number: its deviation from the mean of the recording, and its rate.
  double value_of(const CovariateSpec& number) const { return now().covariates[number]; }
  double rate_of(const CovariateSpec& number) const { return now().rates[number]; }
  /// A covariate that is a vector, platform axes.
  Vec3T<S> vector_of(const CovariateSpec& c) const {
    return to_platform(now().covariates.vector(c).template cast<S>());
  }
  /// Nominal rate of the platform against the case: it does what it is told [rad/s].
  Vec3T<S> omega_cp_p() const {
    Vec3T<S> w;
    for (int i = 0; i < 3; ++i) w[i] = omega_cmd_p[i] - omega_ic_p[i];
    return w;
  }
  /// The same with what drift makes of it, where a term needs its own rate [rad/s].
  Vec3T<S> omega_cp_p_with_drift() const {
    Vec3T<S> w = omega_cp_p();
    for (int i = 0; i < 3; ++i) w[i] += around->omega_drift_p[i];
    return w;
  }
  /// A vector given in local axes, in platform axes.
  Vec3T<S> to_platform(const Vec3T<S>& v_l) const { return around->R_lp.transpose() * v_l; }
};

/// The slots of eqs. (1) to (6) that a term may add to.
template <class S>
struct RateAssembly {
  Mat3T<S> E_gp = Mat3T<S>::Zero();            ///< C_gp - I: misalignment of the input axes [rad]
  Vec3T<S> omega_drift_g = Vec3T<S>::Zero();   ///< w_l, internal drift of each gyro [rad/s]
  Vec3T<S> omega_torque_g = Vec3T<S>::Zero();  ///< w_md, torquer-equivalent rate [rad/s]
  S lambda = S(0.0);                           ///< weight of eq. (6) in the lambda family
  /// Rate of the platform that no gyro takes part in: a leak of base motion, or the apparent rate
  /// of the local axes where they turn otherwise than the site says [rad/s].
  Vec3T<S> omega_ip_p = Vec3T<S>::Zero();
};

/// The slots of the readout.
template <class S>
struct ReadoutAssembly {
  Vec3T<S> acc;  ///< accelerometer outputs [g]; starts as the specific force
};

/// The slots of the gimbal readout.
template <class S>
struct GimbalAssembly {
  Vec3T<S> error = Vec3T<S>::Zero();        ///< added to outer, middle, inner [rad]
  Vec3T<S> case_tilt_l = Vec3T<S>::Zero();  ///< rotation of the case against the local axes [rad]
};

/// A short stretch of a path: what drives the memory of terms. In simulator and filters it is the
/// nominal path: what drift makes of it is left out, which is little of the specific force and may
/// be all of the turns of gimbals that nominally stand still (sim/memory_left_out.hpp).
struct PathStep {
  double dt = 0.0;           ///< [s]; 0 where the platform is caged and only the gimbals move
  Vec3 f0_p = Vec3::Zero();  ///< specific force at its ends, linear between [g]
  Vec3 f1_p = Vec3::Zero();
  Vec3 omega_cmd_p = Vec3::Zero();  ///< [rad/s]
  /// Change of the gimbal angles, outer, middle, inner, until they reverse [rad] ...
  Vec3 turned = Vec3::Zero();
  Vec3 turned_back = Vec3::Zero();     ///< ... and from then on
  Vec3 until_reversal = Vec3::Ones();  ///< part of dt; 1 where they do not
  /// Rate at the beginning over the mean until they reverse, from which it changes evenly: 1 where
  /// it does not, 2 where the gimbal comes to rest. From a reversal on it grows evenly from none.
  Vec3 begin_rate = Vec3::Ones();
};

}  // namespace drift
