#pragma once

#include "core/base/dual.hpp"
#include "core/physics/closure.hpp"
#include "core/physics/earth.hpp"
#include "core/physics/gimbals.hpp"

namespace drift {

/// Which equation, which terms, which axes: everything but the numbers.
struct DriftModel {
  Coupling coupling = Coupling::eq5;
  TermMask terms;
  Mounting mounting;
};

/// eta x y z, xi x y z [rad].
using MisalignmentAngles = Eigen::Matrix<double, 6, 1>;

/// E = C_gp - I for given angles [rad].
Mat3 misalignment_matrix(const Mounting& mounting, const MisalignmentAngles& angles);

/// The slots of all active terms at one instant. The torquer obeys the command: w_md = -w_cmd +
/// terms.
template <class S>
RateAssembly<S> assemble(const DriftModel& model, const Inputs<S>& in, const S* theta) {
  RateAssembly<S> out;
  for (int i = 0; i < 3; ++i) out.omega_torque_g[i] = S(-in.omega_cmd_p[i]);
  TermLibrary::rates(model.terms, in, theta, out);
  return out;
}

/// The part K of the misalignment that the servo loop closes over, w_cp = -(I + K)^-1 (C w_ic + u).
template <class S>
struct ClosedOver {
  S share;  ///< of E that is in K
  Mat3T<S> K;
};
/// Nothing for eq. (5), E for eq. (6), lambda E between, the loop's own estimate when compensated.
template <class S>
ClosedOver<S> closed_over(Coupling coupling, const Mat3T<S>& E_gp, const S& lambda,
                          const Mat3& E_loop) {
  switch (coupling) {
    case Coupling::eq6:
      return {S(1.0), E_gp};
    case Coupling::lambda:
      return {lambda, E_gp * lambda};
    case Coupling::compensated:
      return {S(0.0), E_loop.template cast<S>()};
    case Coupling::eq5:
    case Coupling::servo:
      break;
  }
  return {S(0.0), Mat3T<S>::Zero()};
}

/// Inertial rate of the platform, platform axes [rad/s], shape 3, of the algebraic couplings:
///
///   w_ip = w_ic - (I + K)^-1 (C w_ic + u) = -(I + K)^-1 ((E - K) w_ic + u),   u = w_l + w_md,
///
/// eq. (5) for K = 0, eq. (6) for K = E. The second form has no cancellation of Earth rate.
/// of the slots that all terms have added to. E_loop: the loop's estimate of E [rad], used by
/// coupling "compensated" alone.
/// Source: Fu, Shao, Deng, Control and Decision 17(3), 2002, eqs. (5), (6);
/// physics.md 1.2, 1.3, 1.6.
template <class S>
Vec3T<S> rate_of_slots(Coupling coupling, const RateAssembly<S>& a, const Vec3T<S>& omega_ic_p,
                       const Mat3& E_loop) {
  const Mat3T<S> K = closed_over(coupling, a.E_gp, a.lambda, E_loop).K;
  const Vec3T<S> u = a.omega_drift_g + a.omega_torque_g;
  const Vec3T<S> s = (a.E_gp - K) * omega_ic_p + u;
  if (coupling == Coupling::eq5) return a.omega_ip_p - s;
  const Mat3T<S> M = Mat3T<S>::Identity() + K;
  // Adjugate over determinant: exact, differentiable, and M is near the identity.
  const Vec3T<S> r0 = M.row(0), r1 = M.row(1), r2 = M.row(2);
  const Vec3T<S> c12 = r1.cross(r2), c20 = r2.cross(r0), c01 = r0.cross(r1);
  const S det = r0.dot(c12);
  const Vec3T<S> adj_s = c12 * s[0] + c20 * s[1] + c01 * s[2];
  return a.omega_ip_p - adj_s / det;
}

/// The same at one instant. theta: every parameter of TermLibrary in SI.
template <class S>
Vec3T<S> platform_rate(const DriftModel& model, const Inputs<S>& in, const S* theta,
                       const Mat3& E_loop) {
  return rate_of_slots(model.coupling, assemble(model, in, theta), in.omega_ic_p, E_loop);
}

/// By what the platform turns otherwise than it is told [rad/s].
inline Vec3 drift_rate(const DriftModel& model, const Inputs<double>& in, const double* theta,
                       const Mat3& E_loop) {
  return platform_rate(model, in, theta, E_loop) - in.omega_cmd_p;
}

/// The same as accelerometer_output, for models with terms beyond the first ones.
template <class S>
[[gnu::noinline]] Vec3T<S> offset_accelerometer_output(const DriftModel& model, const Inputs<S>& in,
                                                       const S* theta) {
  Inputs<S> offset = in;
  if (TermLibrary::offset_attitude(model.terms)) {
    const Vec3T<S> delta_p = TermLibrary::attitude_offset(model.terms, in, theta);
    offset.f_p = rotation(delta_p).transpose() * in.f_p;
  }
  ReadoutAssembly<S> out{offset.f_p};
  TermLibrary::readout(model.terms, offset, theta, out);
  return out.acc;
}

/// What the three accelerometers say [g], without noise.
template <class S>
Vec3T<S> accelerometer_output(const DriftModel& model, const Inputs<S>& in, const S* theta) {
  if (!TermLibrary::plain_readout(model.terms))
    return offset_accelerometer_output(model, in, theta);
  ReadoutAssembly<S> out{in.f_p};
  TermLibrary::first_readout(model.terms, in, theta, out);
  return out.acc;
}

/// The same as gimbal_output, for models with terms that act on what the gimbals show.
template <class S>
[[gnu::noinline]] Vec3T<S> offset_gimbal_output(const DriftModel& model, const Inputs<S>& in,
                                                const Mat3T<S>& R_lp, double heading,
                                                const S* theta) {
  const Vec3T<S> delta_p = TermLibrary::attitude_offset(model.terms, in, theta);
  GimbalAssembly<S> out;
  TermLibrary::gimbals(model.terms, in, theta, out);
  const Mat3T<S> R_tp = rotation(out.case_tilt_l).transpose() * R_lp * rotation(delta_p);
  return gimbal_angles<S>(case_attitude(heading).transpose().template cast<S>() * R_tp) + out.error;
}

/// What the resolvers say [rad]: outer, middle, inner, without noise, for the attitude R_lp of the
/// platform and the heading of the case. The case may be tilted, the platform hang off:
/// R_cp = R_lc^T exp(-[tilt_l x]) R_lp exp([delta_p x]).
template <class S>
Vec3T<S> gimbal_output(const DriftModel& model, const Inputs<S>& in, const Mat3T<S>& R_lp,
                       double heading, const S* theta) {
  if (TermLibrary::act_on_gimbals(model.terms))
    return offset_gimbal_output(model, in, R_lp, heading, theta);
  return gimbal_angles<S>(case_attitude(heading).transpose().template cast<S>() * R_lp);
}

// The many terms that a model seldom has are compiled once (drift_model.cpp), so that they take
// neither time to compile nor room in the compiler's inlining where every model runs.
#define DRIFT_SELDOM(S, prefix)                                                                   \
  prefix template void TermLibrary::further_rates<S>(const TermMask&, const Inputs<S>&, const S*, \
                                                     RateAssembly<S>&);                           \
  prefix template Vec3T<S> offset_accelerometer_output<S>(const DriftModel&, const Inputs<S>&,    \
                                                          const S*);                              \
  prefix template Vec3T<S> offset_gimbal_output<S>(const DriftModel&, const Inputs<S>&,           \
                                                   const Mat3T<S>&, double, const S*)
DRIFT_SELDOM(double, extern);
DRIFT_SELDOM(Dual<15>, extern);  // the servo's states

}  // namespace drift
