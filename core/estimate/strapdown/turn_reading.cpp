#include "core/estimate/strapdown/turn_reading.hpp"

#include "core/base/check.hpp"

namespace drift::strapdown {
namespace {

/// Time from the middle of what sample k - 1 is read over to that of sample k [s].
double between_middles(const Signals& s, std::size_t k) {
  const double dt = s.time[k] - s.time[k - 1];
  return s.means ? dt + 0.5 * (s.covered(k - 1) - s.covered(k)) : dt;
}

/// Rate at the time of sample k: of means, on the line between the middles of this and the next.
Vec3 rate_at(const Signals& s, std::size_t k) {
  if (!s.means || k + 1 == s.size() || !s.gyro[k + 1].allFinite() ||
      s.time[k + 1] - s.time[k] > longest_step * s.interval)
    return s.gyro[k];
  const double part = 0.5 * s.covered(k) / between_middles(s, k + 1);
  return s.gyro[k] + part * (s.gyro[k + 1] - s.gyro[k]);
}

/// Sums over the samples of a row, each with its share of the row.
struct RowSums {
  Vec3 acc = Vec3::Zero(), rate = Vec3::Zero();
  Mat3 mean = Mat3::Zero();     ///< attitude at the beginning against the case
  Mat3 squares = Mat3::Zero();  ///< of the rate's cross product
  void add(double share, const Vec3& w, const Vec3& f, const Mat3& attitude) {
    const Mat3 cross = skew(w);
    acc += share * f;
    rate += share * w;
    squares += share * cross * cross;
    mean += share * attitude;
  }
};

/// Mean attitude over an even turn, by Simpson's rule: error turn^4 / 2880.
Mat3 mean_attitude(const Mat3& before, const Mat3& half_way, const Mat3& after) {
  return (before + 4.0 * half_way + after) / 6.0;
}

}  // namespace

Vec3 turned(const Signals& s, std::size_t k, const Vec3& drift) {
  const double dt = s.time[k] - s.time[k - 1];
  const Vec3 a = s.gyro[k - 1] - drift, b = s.gyro[k] - drift;
  return dt * (mean_between(s, s.gyro, k) - drift) +
         dt * dt * dt / (12.0 * between_middles(s, k)) * a.cross(b);
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
  RowSums sums;
  Mat3 C = Mat3::Identity();
  for (std::size_t k = first + 1; k <= last; ++k) {
    const double share = (s.time[k] - s.time[k - 1]) / length;
    const Vec3 turn = turned(s, k, Vec3::Zero());
    const Mat3 before = C.transpose();
    C = C * rotation(turn);
    if (s.means) {
      // Half of the turn, less what is turned later than evenly by a rate that grows.
      const double dt = s.time[k] - s.time[k - 1];
      const Vec3 later = dt * dt / (8.0 * between_middles(s, k)) * (s.gyro[k] - s.gyro[k - 1]);
      const Mat3 half_way = rotation(Vec3(later - 0.5 * turn)) * before;
      sums.add(share, mean_between(s, s.gyro, k), mean_between(s, s.acc, k),
               mean_attitude(before, half_way, C.transpose()));
    } else {
      // What accelerometers read at instants, and the attitude and the rate at these, by one rule:
      // what it lacks of one it lacks of the others.
      sums.add(0.5 * share, s.gyro[k - 1], s.acc[k - 1], before);
      sums.add(0.5 * share, s.gyro[k], s.acc[k], C.transpose());
    }
  }
  // Simpson's rule, as the prediction takes it.
  const Mat3 half_way = rotation(Vec3(-0.5 * rotation_vector(C)));
  const Mat3 even = mean_attitude(Mat3::Identity(), half_way, C.transpose());
  TurnReading out;
  out.acc = sums.acc + (even - sums.mean) * f_first;
  out.turn.rate = sums.rate;
  const Vec3 acceleration = (rate_at(s, last) - rate_at(s, first)) / length;
  out.turn.arm = (skew(acceleration) + sums.squares) / gravity;
  return out;
}

}  // namespace drift::strapdown
