#pragma once

#include "core/physics/term.hpp"

namespace drift {

/// The four hooks of terms seen alike: each adds to an assembly, whose numbers, in a row, are its
/// slots. What they stand for is known to whoever chains their derivatives
/// (core/estimate/linearizer). has: whether a type has the hook; acts: whether a term uses it,
/// which a place for a study's own term may not.
struct RatesHook {
  static constexpr int slots = 16;
  /// Slot of E_gp(gyro, column), of w_l + w_md of a gyro, of the rate no gyro takes part in.
  static constexpr int E(int gyro, int column) { return 3 * column + gyro; }
  static constexpr int u(int gyro) { return 9 + gyro; }
  static constexpr int omega(int axis) { return 12 + axis; }
  static constexpr int lambda = 15;

  template <class S>
  using Assembly = RateAssembly<S>;
  template <class T>
  static constexpr bool has = ActsOnRates<T, double>;
  static bool acts(const TermInfo& term) { return term.in_rates; }
  template <class T, class S>
  static void add(const Inputs<S>& in, const S* p, const S* m, Assembly<S>& to) {
    if constexpr (memory_of<T>() > 0)
      T::rates(in, p, m, to);
    else
      T::rates(in, p, to);
  }
  template <class S>
  static S slot(const Assembly<S>& a, int k) {
    if (k < u(0)) return a.E_gp.data()[k];
    if (k < omega(0)) return a.omega_drift_g[k - u(0)] + a.omega_torque_g[k - u(0)];
    return k < lambda ? a.omega_ip_p[k - omega(0)] : a.lambda;
  }
};

/// Rotation of the platform that accelerometers and resolvers see, platform axes.
struct OffsetHook {
  static constexpr int slots = 3;
  template <class S>
  struct Assembly {
    Vec3T<S> delta_p = Vec3T<S>::Zero();
  };
  template <class T>
  static constexpr bool has = OffsetsAttitude<T, double>;
  static bool acts(const TermInfo& term) { return term.in_offset; }
  template <class T, class S>
  static void add(const Inputs<S>& in, const S* p, const S* m, Assembly<S>& to) {
    if constexpr (memory_of<T>() > 0)
      T::attitude_offset(in, p, m, to.delta_p);
    else
      T::attitude_offset(in, p, to.delta_p);
  }
  template <class S>
  static S slot(const Assembly<S>& a, int k) {
    return a.delta_p[k];
  }
};

/// The three accelerometers.
struct ReadoutHook {
  static constexpr int slots = 3;
  template <class S>
  struct Assembly : ReadoutAssembly<S> {
    Assembly() : ReadoutAssembly<S>{Vec3T<S>::Zero()} {}
  };
  template <class T>
  static constexpr bool has = ActsOnReadout<T, double>;
  static bool acts(const TermInfo& term) { return term.in_readout; }
  template <class T, class S>
  static void add(const Inputs<S>& in, const S* p, const S*, Assembly<S>& to) {
    T::readout(in, p, to);
  }
  template <class S>
  static S slot(const Assembly<S>& a, int k) {
    return a.acc[k];
  }
};

/// Errors of the resolvers, then the tilt of the case.
struct GimbalsHook {
  static constexpr int slots = 6;
  template <class S>
  using Assembly = GimbalAssembly<S>;
  template <class T>
  static constexpr bool has = ActsOnGimbals<T, double>;
  static bool acts(const TermInfo& term) { return term.in_gimbals; }
  template <class T, class S>
  static void add(const Inputs<S>& in, const S* p, const S*, Assembly<S>& to) {
    T::gimbals(in, p, to);
  }
  template <class S>
  static S slot(const Assembly<S>& a, int k) {
    return k < 3 ? a.error[k] : a.case_tilt_l[k - 3];
  }
};

}  // namespace drift
