#include "core/estimate/strapdown/turn_reading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace drift::strapdown::turn_reading_test {
namespace {

/// What an even turn of so much about an axis reads of `f0`, by steps.
Vec3 even_turn(double whole, const Vec3& axis, const Vec3& f0) {
  Vec3 even = Vec3::Zero();
  constexpr int steps = 1000;
  for (int k = 0; k < steps; ++k)
    even += rotation(Vec3(-whole * (k + 0.5) / steps * axis)) * f0 / steps;
  return even;
}

/// Of a row of such a length that turns at 1 rad/s^2 from rest.
void expect_row_of_even_turn(const TurnReading& read, double length, const Vec3& axis,
                             const Vec3& f0, double gravity) {
  EXPECT_LT((read.acc - even_turn(0.5 * length * length, axis, f0)).norm(), 2e-7);
  EXPECT_LT((read.turn.rate - 0.5 * length * axis).norm(), 1e-12);
  const Mat3 expected = (skew(axis) + length * length / 3.0 * skew(axis) * skew(axis)) / gravity;
  EXPECT_LT((read.turn.arm - expected).norm(), 1e-5);
}

/// A row in which the rate changes reads as an even turn does; the acceleration is the change of
/// the rate over the row.
TEST(TurnReading, IsThatOfAnEvenTurn) {
  constexpr double dt = 0.002, length = 0.4, gravity = 9.8;
  const Vec3 axis = Vec3(1.0, -2.0, 0.5).normalized(), f0(0.6, 0.0, 0.8);
  Signals s;
  s.interval = dt;
  for (int k = 0; k <= 200; ++k) {
    const double t = dt * k, angle = 0.5 * t * t;  // 1 rad/s^2 from rest
    s.time.push_back(t);
    s.gyro.push_back(t * axis);
    s.acc.push_back(rotation(Vec3(-angle * axis)) * f0);
  }
  const TurnReading read = turn_reading(s, 0, 200, f0, gravity);
  expect_row_of_even_turn(read, length, axis, f0, gravity);
  // What the correction is of.
  EXPECT_GT((s.acc[100] - even_turn(0.5 * length * length, axis, f0)).norm(), 1e-2);
}

/// The same of means over the samples, whose last ends with the row: of the rate, and of what the
/// accelerometers see on the way.
TEST(TurnReading, OfMeansIsThatOfAnEvenTurn) {
  constexpr double dt = 0.01, length = 0.4, gravity = 9.8;
  const Vec3 axis = Vec3(1.0, -2.0, 0.5).normalized(), f0(0.6, 0.0, 0.8);
  const auto force = [&](double t) -> Vec3 { return rotation(Vec3(-0.5 * t * t * axis)) * f0; };
  Signals s;
  s.interval = dt;
  s.means = true;
  for (int k = 0; k <= 41; ++k) {  // the row ends with sample 40; turns at 1 rad/s^2 from t = 0
    const double t = dt * k;
    s.time.push_back(t);
    s.gyro.push_back((t - 0.5 * dt) * axis);
    s.acc.push_back((force(t - dt) + 4.0 * force(t - 0.5 * dt) + force(t)) / 6.0);
  }
  const TurnReading read = turn_reading(s, 0, 40, f0, gravity);
  expect_row_of_even_turn(read, length, axis, f0, gravity);
}

/// The axis z of a case goes round a cone of half-angle `half`, `turns` times a second, and the
/// case does not turn about it: C = exp(half (-sin, cos, 0)). Its rate, and the integral of that,
/// are known.
struct Coning {
  double half, turns;

  double phase(double t) const { return 2.0 * std::numbers::pi * turns * t; }
  Mat3 attitude(double t) const {
    return rotation(Vec3(half * Vec3(-std::sin(phase(t)), std::cos(phase(t)), 0.0)));
  }
  Vec3 rate(double t) const {
    return 2.0 * std::numbers::pi * turns *
           Vec3(-std::sin(half) * std::cos(phase(t)), -std::sin(half) * std::sin(phase(t)),
                std::cos(half) - 1.0);
  }
  Vec3 integral(double t) const {
    return Vec3(-std::sin(half) * std::sin(phase(t)), std::sin(half) * std::cos(phase(t)),
                (std::cos(half) - 1.0) * phase(t));
  }
  /// Samples at these times: angles gained since the time before over it, or the rate there.
  Signals read_at(const std::vector<double>& times, bool means) const {
    Signals s;
    s.means = means;
    s.interval = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    for (const double t : times) {
      const double before = s.time.empty() ? t - s.interval : s.time.back();
      s.gyro.push_back(means ? Vec3((integral(t) - integral(before)) / (t - before)) : rate(t));
      s.time.push_back(t);
      s.acc.push_back(Vec3::UnitZ());
    }
    return s;
  }
  /// Attitude that is lost from one sample to another [rad].
  double error(const Signals& s, std::size_t first, std::size_t last) const {
    Mat3 C = attitude(s.time[first]);
    for (std::size_t k = first + 1; k <= last; ++k) C = C * rotation(turned(s, k, Vec3::Zero()));
    return rotation_vector(Mat3(attitude(s.time[last]).transpose() * C)).norm();
  }
  double error(const Signals& s) const { return error(s, 0, s.size() - 1); }
};

constexpr Coning wobble{0.0139, 2.0};  // 10 deg/s at 2 Hz

/// Two seconds of it, every `dt`; each other step longer and each other shorter by `uneven` of it.
std::vector<double> times_every(double dt, double uneven = 0.0) {
  std::vector<double> times;
  const int steps = static_cast<int>(std::lround(2.0 / dt));
  for (int k = 0; k <= steps; ++k) times.push_back(dt * (k + (k % 2 == 1 ? uneven : 0.0)));
  return times;
}

/// Taken for instants they lose a twelfth of (angle of the motion in a sample)^2.
TEST(TurnReading, AnglesGainedAreJoinedToFourthOrder) {
  double before = 0.0, wrong_before = 0.0;
  for (const double dt : {0.02, 0.01, 0.005}) {
    const Signals means = wobble.read_at(times_every(dt), true);
    const double error = wobble.error(means);
    if (before > 0.0) EXPECT_NEAR(before / error, 16.0, 1.0) << dt;
    before = error;
    Signals taken_for_instants = means;
    taken_for_instants.means = false;
    const double wrong = wobble.error(taken_for_instants);
    if (wrong_before > 0.0) EXPECT_NEAR(wrong_before / wrong, 4.0, 0.3) << dt;
    wrong_before = wrong;
  }
  EXPECT_LT(before, 2e-9);
  EXPECT_GT(wrong_before, 100.0 * before);
}

/// A clock that jitters, and means of its own intervals.
TEST(TurnReading, AnglesGainedInUnevenIntervalsAreJoinedAsWell) {
  const double even = wobble.error(wobble.read_at(times_every(0.01), true)),
               uneven = wobble.error(wobble.read_at(times_every(0.01, 0.2), true));
  EXPECT_LT(uneven, 4.0 * even);
}

/// One row is lost: what was gained in it is half of each neighbour's.
TEST(TurnReading, AMeanStandsForItsOwnIntervalBehindALostRow) {
  Signals s = wobble.read_at(times_every(0.01), true);
  const std::size_t lost = 77;
  const Vec3 gained = 0.01 * s.gyro[lost];
  const Vec3 bridged = 0.005 * (s.gyro[lost - 1] + s.gyro[lost + 1]);
  const double whole = wobble.error(s);
  const auto at = static_cast<std::ptrdiff_t>(lost);
  s.time.erase(s.time.begin() + at);
  s.gyro.erase(s.gyro.begin() + at);
  s.acc.erase(s.acc.begin() + at);
  EXPECT_DOUBLE_EQ(s.covered(lost), 0.01);
  EXPECT_NEAR(wobble.error(s), whole + (bridged - gained).norm(),
              0.2 * (bridged - gained).norm() + whole);
}

/// Instants, a clock that jitters, and a row that is lost.
TEST(TurnReading, InstantsAreJoinedToFourthOrder) {
  for (const double uneven : {0.0, 0.2}) {
    double before = 0.0, with_ends = 0.0;
    for (const double dt : {0.02, 0.01, 0.005}) {
      const Signals s = wobble.read_at(times_every(dt, uneven), false);
      const double error = wobble.error(s, 1, s.size() - 2), whole = wobble.error(s);
      if (before > 0.0) EXPECT_GT(before / error, 12.0) << dt;
      if (before > 0.0) EXPECT_GT(with_ends / whole, 12.0) << dt << ": parabolas at both ends";
      before = error;
      with_ends = whole;
    }
    EXPECT_LT(before, 5e-9);  // the trapezoid's: 1.6e-6
  }
}

TEST(TurnReading, ALostRowOfInstantsIsBridgedByTheCubic) {
  double before = 0.0;
  for (const double dt : {0.01, 0.005, 0.0025}) {
    std::vector<double> times = times_every(dt);
    const auto lost = static_cast<std::size_t>(std::lround(0.77 / dt));
    times.erase(times.begin() + static_cast<std::ptrdiff_t>(lost));
    Signals s = wobble.read_at(times, false);
    s.interval = dt;
    const double error = wobble.error(s, lost - 4, lost + 4);
    if (before > 0.0) EXPECT_GT(before / error, 12.0) << dt;
    before = error;
  }
}

/// A sample that was not measured: the turns beside it are those of parabolas, of fourth order each
/// as they are few; between two of them the trapezoid's, of third.
TEST(TurnReading, InstantsBesideWhatIsNotMeasuredFallBack) {
  double beside = 0.0, between = 0.0;
  for (const double dt : {0.01, 0.005, 0.0025}) {
    Signals s = wobble.read_at(times_every(dt), false);
    const auto k = static_cast<std::size_t>(std::lround(0.77 / dt));
    s.gyro[k + 1].setConstant(std::nan(""));
    EXPECT_FALSE(turned(s, k + 1, Vec3::Zero()).allFinite());
    EXPECT_FALSE(turned(s, k + 2, Vec3::Zero()).allFinite());
    const double parabola = wobble.error(s, k - 1, k);
    if (beside > 0.0) EXPECT_GT(beside / parabola, 12.0) << dt;
    beside = parabola;
    s.gyro[k - 2].setConstant(std::nan(""));
    const Vec3 a = s.gyro[k - 1], b = s.gyro[k];
    const Vec3 trapezoid = 0.5 * dt * (a + b) + dt * dt / 12.0 * a.cross(b);
    EXPECT_LT((turned(s, k, Vec3::Zero()) - trapezoid).norm(), 1e-16);
    const double line = wobble.error(s, k - 1, k);
    EXPECT_GT(line, parabola);
    if (between > 0.0) EXPECT_GT(between / line, 6.0) << dt;
    between = line;
  }
}

TEST(TurnReading, OfAnEvenTurnIsExact) {
  const Vec3 rate(0.3, -0.7, 1.1), drift(1e-3, -2e-3, 3e-3);
  Signals s;
  s.interval = 0.01;
  for (const double t : {0.0, 0.01, 0.0187, 0.031, 0.051, 0.06}) {
    s.time.push_back(t);
    s.gyro.push_back(rate + drift);
    s.acc.push_back(Vec3::UnitZ());
  }
  for (std::size_t k = 1; k < s.size(); ++k)
    EXPECT_LT((turned(s, k, drift) - (s.time[k] - s.time[k - 1]) * rate).norm(), 1e-17) << k;
}

}  // namespace
}  // namespace drift::strapdown::turn_reading_test
