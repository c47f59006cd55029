#pragma once

#include <Eigen/LU>

#include "core/physics/drift_model.hpp"
#include "core/physics/hooks.hpp"

namespace drift {

/// From the derivatives of the slots to those of the platform's rate, by one formula for every
/// coupling (physics.md 1.6):
///
///   w_ip = w_o - v,  (I + K) v = (E - K) w_ic + u,
///   dw_ip = dw_o - (I + K)^-1 (dE l - dshare E (w_ic + v) + (E - K) dw_ic + du),
///   l = (1 - share) w_ic - share v,  K = share E  (or fixed, then share = 0).
///
/// S: double, or several instants at once.
template <class S>
class RateChain {
 public:
  using D3 = Dual<3, S>;

  /// slots: summed over the terms, with derivatives by three directions of attitude. omega_ic_p:
  /// likewise. R_ip: what the columns are turned by.
  RateChain(const DriftModel& model, const std::array<D3, RatesHook::slots>& slots,
            const Vec3T<D3>& omega_ic_p, const Vec3& omega_cmd_p, const Mat3& E_loop,
            const Mat3T<S>& R_ip) {
    using H = RatesHook;
    Mat3T<S> E;
    for (int i = 0; i < 9; ++i) E.data()[i] = slots[static_cast<std::size_t>(i)].v;
    const D3& lambda = slots[H::lambda];
    const auto [share, K] = closed_over(model.coupling, E, lambda.v, E_loop);
    const Mat3T<S> open = E - K;
    const Mat3T<S> minus_closed = -Mat3T<S>(Mat3T<S>::Identity() + K).inverse();
    Vec3T<S> w, torqued, omega_o_p;
    for (int i = 0; i < 3; ++i) {
      w[i] = omega_ic_p[i].v;
      torqued[i] = slots[H::u(i)].v - omega_cmd_p[i];
      omega_o_p[i] = slots[H::omega(i)].v;
    }
    const Vec3T<S> v = -(minus_closed * (open * w + torqued));
    lever_ = (S(1.0) - share) * w - share * v;
    const Vec3T<S> by_share =
        model.coupling == Coupling::lambda ? Vec3T<S>(-(E * (w + v))) : Vec3T<S>(Vec3T<S>::Zero());
    omega_ip_p_ = omega_o_p - v;
    for (int k = 0; k < 3; ++k) {
      Vec3T<S> dw, ds;
      for (int i = 0; i < 3; ++i) dw[i] = omega_ic_p[i].d[k];
      ds = open * dw + by_share * lambda.d[k];
      for (int i = 0; i < 3; ++i) ds[i] += slots[H::u(i)].d[k];
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 3; ++i) ds[i] += slots[H::E(i, c)].d[k] * lever_[c];
      for (int i = 0; i < 3; ++i) dw[i] = slots[H::omega(i)].d[k];
      by_attitude_.col(k) = dw + minus_closed * ds;
    }
    R_ip_ = R_ip;
    by_gyro_ = R_ip * minus_closed;
    share_i_ = by_gyro_ * by_share;
  }

  const Vec3T<S>& omega_ip_p() const { return omega_ip_p_; }
  /// d omega_ip_p by the three directions, as columns.
  const Mat3T<S>& by_attitude() const { return by_attitude_; }
  /// R_ip d omega_ip_p where a slot changes by d.
  Vec3T<S> by_slot(int slot, const S& d) const {
    using H = RatesHook;
    if (slot < H::u(0)) return by_gyro_.col(slot % 3) * (d * lever_[slot / 3]);
    if (slot < H::omega(0)) return by_gyro_.col(slot - H::u(0)) * d;
    if (slot < H::lambda) return R_ip_.col(slot - H::omega(0)) * d;
    return share_i_ * d;
  }

 private:
  Mat3T<S> R_ip_, by_gyro_, by_attitude_;
  Vec3T<S> omega_ip_p_, lever_, share_i_;
};

}  // namespace drift
