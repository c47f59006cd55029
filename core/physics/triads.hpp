#pragma once

#include <array>

#include "core/base/linalg.hpp"

namespace drift {

/// A platform axis with a sign: +x is {0, 1}, -z is {2, -1}.
struct SignedAxis {
  int index = 0;
  double sign = 1.0;
};

/// How the three instruments of a kind sit on the platform: for each, its second and third axis.
/// Gyros: (input, output, spin), right-handed, I x O = S. Accelerometers: (input, pendulous,
/// output). Default (physics.md 1.1): X (x,y,z), Y (y,z,x), Z (z,x,y).
struct Triads {
  std::array<SignedAxis, 3> second{{{1, 1.0}, {2, 1.0}, {0, 1.0}}};
  std::array<SignedAxis, 3> third{{{2, 1.0}, {0, 1.0}, {1, 1.0}}};

  template <class S>
  Vec3T<S> along_second(const Vec3T<S>& v_p) const {
    return along(second, v_p);
  }
  template <class S>
  Vec3T<S> along_third(const Vec3T<S>& v_p) const {
    return along(third, v_p);
  }

 private:
  template <class S>
  static Vec3T<S> along(const std::array<SignedAxis, 3>& axes, const Vec3T<S>& v_p) {
    return {axes[0].sign * v_p[axes[0].index], axes[1].sign * v_p[axes[1].index],
            axes[2].sign * v_p[axes[2].index]};
  }
};

/// The instruments' axes of a whole platform.
struct Mounting {
  Triads gyro;
  Triads accelerometer;
};

}  // namespace drift
