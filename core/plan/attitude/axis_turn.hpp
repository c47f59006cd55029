#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift {

/// A turn of the platform about one of its own axes.
struct AxisTurn {
  std::string text;    ///< "10 deg about y", as given
  int axis = 0;        ///< x, y, z, from 0
  double angle = 0.0;  ///< right-handed [rad]
};

/// What turns make of an attitude, done one after the other, each about an axis where those before
/// left it: v_p = R v_q of the platform p before and q after them, R_lq = R_lp R. Quarter turns are
/// exact.
Mat3 rotation_of(std::span<const AxisTurn> turns);

}  // namespace drift
