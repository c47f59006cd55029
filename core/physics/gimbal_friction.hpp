#pragma once

#include "core/physics/gimbals.hpp"
#include "core/physics/memory.hpp"
#include "core/physics/term.hpp"

namespace drift {

/// What terms share that have the friction of the gimbals behind them. Memory: the friction of
/// each gimbal over its Coulomb friction, outer, middle, inner, driven by the nominal gimbal
/// motion; none where a test begins. Parameters: an amplitude for each gimbal, then the turn over
/// which friction builds up [rad].
struct GimbalFriction {
  static constexpr Needs needs{.gimbals = true};
  static constexpr int memory = 3;
  static constexpr std::size_t memory_parameter = 3;

  template <class S>
  static void start(const PathStep&, const S*, S* T) {
    for (int k = 0; k < 3; ++k) T[k] = S(0.0);
  }
  template <class S>
  static void advance(const PathStep& along, const S* p, S* T) {
    const S turn = friction_turn(p[3]);
    for (int k = 0; k < 3; ++k)
      T[k] = dahl(dahl(T[k], along.turned[k], turn), along.turned_back[k], turn);
  }
  /// Over a step in which the rates of the gimbals change evenly, there and back.
  template <class S>
  static void moments_of(const PathStep& along, const S* p, const S* T, Moments<S>* moments) {
    const S turn = friction_turn(p[3]);
    for (int k = 0; k < 3; ++k) {
      moments[k] = dahl_moments(T[k], along.turned[k], turn, along.begin_rate[k]);
      if (const double until = along.until_reversal[k]; until < 1.0)
        moments[k] = joined(
            until, moments[k],
            dahl_moments(dahl(T[k], along.turned[k], turn), along.turned_back[k], turn, 0.0));
    }
  }
  /// sum -= amplitude times friction along the axis of each gimbal, platform axes.
  template <class S>
  static void take_off(const Inputs<S>& in, const S* p, const S* T, Vec3T<S>& sum) {
    const Mat3T<S> axes = gimbal_axes(in.around->gimbal);
    for (int k = 0; k < 3; ++k) sum -= axes.col(k) * (p[k] * T[k]);
  }
};

}  // namespace drift
