#include "core/plan/attitude/axis_turn.hpp"

#include <cmath>

namespace drift {
namespace {

/// Without what a quarter turn in binary leaves of zero.
double without_rounding(double value) {
  constexpr double rounding = 1e-15;
  return std::abs(value) < rounding ? 0.0 : value;
}

}  // namespace

Mat3 rotation_of(std::span<const AxisTurn> turns) {
  Mat3 R = Mat3::Identity();
  for (const AxisTurn& turn : turns) {
    const double c = without_rounding(std::cos(turn.angle)),
                 s = without_rounding(std::sin(turn.angle));
    const int first = (turn.axis + 1) % 3, second = (turn.axis + 2) % 3;
    Mat3 step = Mat3::Identity();  // the first of the other two axes turns to the second
    step(first, first) = step(second, second) = c;
    step(second, first) = s;
    step(first, second) = -s;
    R = R * step;
  }
  return R;
}

}  // namespace drift
