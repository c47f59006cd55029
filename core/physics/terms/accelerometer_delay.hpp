#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// What the accelerometers of a strapdown unit say is a little behind what its gyros say: gravity
/// as it was before the case turned on. Negative where it is ahead: they are read later than the
/// gyros.
struct AccelerometerDelay {
  static constexpr std::string_view key = "accelerometer_delay";
  static constexpr std::string_view title = "delay of the accelerometers against the gyros";
  static constexpr std::string_view equation = "f += acc_delay (w - w_ie) x f";
  static constexpr std::string_view source = "f' = -(w - w_ie) x f: 1 ms at 10 deg/s is 175 ug";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr auto params =
      single<"acc_delay">("ms"_unit, normal(0.0, 5.0), "accelerometer output, times w x f");
  static constexpr Needs needs{.turning = true};

  template <class S>
  static void readout(const Inputs<S>& in, const S* delay, ReadoutAssembly<S>& out) {
    if (in.now().turn == nullptr) return;
    Vec3T<S> w;
    for (int i = 0; i < 3; ++i) w[i] = in.now().turn->rate[i] - in.omega_ic_p[i];
    out.acc += w.cross(in.f_p) * delay[0];
  }
};

}  // namespace drift::terms
