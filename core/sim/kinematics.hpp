#pragma once

#include <cmath>

#include "core/base/pack.hpp"
#include "core/physics/drift_model.hpp"
#include "core/sim/surroundings.hpp"

namespace drift {

/// What the terms see for a platform attitude R_lp (v_l = R_lp v_p).
template <class S>
Inputs<S> inputs_at(const Vec3& omega_ic_l, const Vec3& omega_cmd_p, const Mounting& mounting,
                    const Mat3T<S>& R_lp) {
  Inputs<S> in;
  in.mounting = &mounting;
  in.f_p = R_lp.row(2);  // R_lp^T up
  in.omega_ic_p = R_lp.transpose() * omega_ic_l.cast<S>();
  in.omega_cmd_p = omega_cmd_p;
  return in;
}

/// The same with all that the terms may ask for beside it. Not copied: `in` points to `around`.
template <class S>
struct Scene {
  Inputs<S> in;
  Surroundings<S> around;  ///< of use after look_around() alone

  Scene(const Vec3& omega_ic_l, const Vec3& omega_cmd_p, const Mounting& mounting,
        const Mat3T<S>& R_lp)
      : in(inputs_at<S>(omega_ic_l, omega_cmd_p, mounting, R_lp)) {}
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void look_around(const Needs& needs, const Moment& now, const Mat3T<S>& R_lp, const S* memory) {
    fill_surroundings(needs, now, R_lp, memory, around);
    in.around = &around;
  }
};

/// k below, for the square of the angle; by series up to 1 rad: the remainder is below 6e-18. Its
/// coefficients are |B_2n| / (2n)!.
inline constexpr double rotation_rate_series_until = 1.0;
template <class S>
S rotation_rate_series(const S& t2) {
  constexpr double even[] = {1.0 / 12.0, 1.0 / 30240.0, 1.0 / 47900160.0, 1.0 / 74724249600.0,
                             43867.0 / 5109094217170944000.0},
                   odd[] = {1.0 / 720.0, 1.0 / 1209600.0, 691.0 / 1307674368000.0,
                            3617.0 / 10670622842880000.0, 174611.0 / 802857662698291200000.0};
  const S t4 = t2 * t2;
  S e(even[4]), o(odd[4]);
  for (int k = 3; k >= 0; --k) {
    e = e * t4 + even[k];
    o = o * t4 + odd[k];
  }
  return e + o * t2;
}
template <class S>
S rotation_rate_coefficient(const S& t2) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  if (t2 < rotation_rate_series_until) return rotation_rate_series(t2);
  const S t = sqrt(t2);
  return 1.0 / t2 - (1.0 + cos(t)) / (2.0 * t * sin(t));
}
template <>
inline Pack rotation_rate_coefficient(const Pack& t2) {
  return lane_by_lane(t2, rotation_rate_series(t2), t2.v >= rotation_rate_series_until,
                      [](double one) { return rotation_rate_coefficient(one); });
}

/// Rate of the rotation vector phi of the platform against its reference, R_rp = exp([phi x]):
///
///   phi' = w_e + phi x w_e / 2 + k phi x (phi x w_e),   w_e = w_ip - R_pr w_ir,
///   k = 1/th^2 - (1 + cos th)/(2 th sin th) -> 1/12.
///
/// w_ir is the command, since the reference does what it is told. physics.md 6.1. [rad/s]
/// R_rp: rotation(phi), which whoever knows omega_ip_p has at hand.
template <class S>
Vec3T<S> rotation_vector_rate(const Vec3T<S>& phi, const Mat3T<S>& R_rp, const Vec3T<S>& omega_ip_p,
                              const Vec3& omega_ir_r) {
  const Vec3T<S> w = omega_ip_p - R_rp.transpose() * omega_ir_r.template cast<S>();
  const S k = rotation_rate_coefficient<S>(phi.squaredNorm());
  const Vec3T<S> c = phi.cross(w);
  return w + 0.5 * c + k * phi.cross(c);
}

/// All that the rate equation needs besides attitude: one model, one set of numbers, one interval.
struct Drive {
  const DriftModel* model = nullptr;
  const double* theta = nullptr;      ///< every parameter of TermLibrary, SI
  Vec3 omega_ic_l = Vec3::Zero();     ///< [rad/s]
  Vec3 omega_ie_l = Vec3::Zero();     ///< of the Earth [rad/s]
  Vec3 omega_cmd_p = Vec3::Zero();    ///< [rad/s]
  Mat3 E_loop = Mat3::Zero();         ///< coupling "compensated" alone [rad]
  Vec3 omega_noise_p = Vec3::Zero();  ///< process noise of the platform rate [rad/s]
  // Where a term needs more than that:
  Needs needs;
  const Timeline* timeline = nullptr;
  const Interval* interval = nullptr;
};

/// phi' of the algebraic couplings, for the reference attitude R_lr [rad/s]. t [s] and the memory
/// (null where the model has none) are looked at if drive.needs says so.
Vec3 attitude_rate(const Drive& drive, const Mat3& R_lr, const Vec3& phi, double t,
                   const double* memory);

/// chi' of the same vector in local axes, chi = R_lr phi, which does not turn with the command:
/// chi' = R_lr (phi' + w_cmd x phi) - w_ie x chi [rad/s].
Vec3 attitude_rate_l(const Drive& drive, const Mat3& R_lr, const Vec3& chi, double t,
                     const double* memory);

}  // namespace drift
