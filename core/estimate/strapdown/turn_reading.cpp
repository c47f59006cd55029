#include "core/estimate/strapdown/turn_reading.hpp"

#include "core/base/check.hpp"

namespace drift::strapdown {

Vec3 turned(const Signals& s, std::size_t k, const Vec3& drift) {
  const double dt = s.time[k] - s.time[k - 1];
  const Vec3 a = s.gyro[k - 1] - drift, b = s.gyro[k] - drift;
  return 0.5 * dt * (a + b) + dt * dt / 12.0 * a.cross(b);
}

bool speeds_up(const Signals& s, std::size_t k) {
  constexpr double of_the_rate = 1e-3;
  return (s.gyro[k + 1] - s.gyro[k]).norm() > of_the_rate * s.gyro[k].norm();
}

std::vector<Vec3> carried_force(const Signals& s, std::size_t first, std::size_t last,
                                const Vec3& before, const Vec3& after) {
  std::vector<Vec3> f(last - first + 1);
  f.front() = before;
  f.back() = after;
  const std::size_t middle = f.size() / 2;
  for (std::size_t k = 1; k < middle; ++k)
    f[k] = rotation(turned(s, first + k, Vec3::Zero())).transpose() * f[k - 1];
  for (std::size_t k = f.size() - 1; k > middle; --k)
    f[k - 1] = rotation(turned(s, first + k, Vec3::Zero())) * f[k];
  return f;
}

TurnReading turn_reading(const Signals& s, std::size_t first, std::size_t last, const Vec3& f_first,
                         double gravity) {
  DRIFT_EXPECTS(first < last);
  const double length = s.time[last] - s.time[first];
  TurnReading out;
  Mat3 C = Mat3::Identity(), mean = Mat3::Zero(), squares = Mat3::Zero();
  const auto add = [&](std::size_t k, double weight) {
    const Mat3 w = skew(s.gyro[k]);
    out.acc += weight * s.acc[k];
    out.turn.rate += weight * s.gyro[k];
    squares += weight * w * w;
    mean += weight * C.transpose();
  };
  for (std::size_t k = first + 1; k <= last; ++k) {
    const double half = 0.5 * (s.time[k] - s.time[k - 1]) / length;
    add(k - 1, half);
    C = C * rotation(turned(s, k, Vec3::Zero()));
    add(k, half);
  }
  // Simpson's rule, as the prediction takes it: error turn^4 / 2880.
  const Mat3 half_way = rotation(Vec3(-0.5 * rotation_vector(C)));
  const Mat3 even = (Mat3::Identity() + 4.0 * half_way + C.transpose()) / 6.0;
  out.acc += (even - mean) * f_first;
  const Vec3 acceleration = (s.gyro[last] - s.gyro[first]) / length;
  out.turn.arm = (skew(acceleration) + squares) / gravity;
  return out;
}

}  // namespace drift::strapdown
