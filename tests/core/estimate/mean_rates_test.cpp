// A unit whose turns wobble: a motion that goes round adds up what the form of its samples makes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/estimate/batch.hpp"
#include "core/recording/recording_format.hpp"
#include "core/recording/sample_kind.hpp"
#include "tests/support/case_unit.hpp"

namespace drift::strapdown::mean_rates_test {
namespace {

using namespace case_unit;

constexpr double dt = 0.01;                          // [s]
constexpr double wobble = 20.0 * detail::deg;        // [rad/s], about an axis that goes round
constexpr double wobbling = 4.0 * std::numbers::pi;  // 2 Hz [rad/s]

/// A turn about a cone: 1 - cos along `axis`, sin^2 of a rate that goes round across it.
struct Turn {
  Vec3 axis, across, third;
  double length, angle;

  Vec3 rate(double t) const {
    const double u = t / length;
    const double round = wobble * std::pow(std::sin(std::numbers::pi * u), 2);
    return angle / length * (1.0 - std::cos(2.0 * std::numbers::pi * u)) * axis +
           round * (std::sin(wobbling * t) * across + std::cos(wobbling * t) * third);
  }
};

/// Rests and turns of a script, written apart from the estimator: sensors that give means over each
/// sample, or instants at its end. The attitude is carried over a tenth of a sample at a time, at
/// the two points of Gauss.
class Wobbling {
 public:
  Wobbling(const test::StrapdownScript& script, SampleKind kind)
      : script_(script), means_(kind == SampleKind::mean_rates) {
    recording_.source = "simulated";
    recording_.channels = {{"time", unit::s, {}}};
    for (const char* name : {"gyro_x", "gyro_y", "gyro_z"})
      recording_.channels.push_back({name, *parse_unit("rad/s"), {}});
    for (const char* name : {"acc_x", "acc_y", "acc_z"})
      recording_.channels.push_back({name, unit::g, {}});
  }

  Recording recording() {
    Stream path(script_.seed, 0, Purpose::test, 0);
    for (std::size_t d = 0; d < script_.dwells; ++d) {
      const auto resting = std::lround(script_.rest / dt), turning = std::lround(script_.turn / dt);
      for (long k = 0; k < resting; ++k) sample([](double) { return Vec3(Vec3::Zero()); }, 0.0);
      if (d + 1 == script_.dwells) break;
      const Vec3 axis = Vec3(path.normal(), path.normal(), path.normal()).normalized();
      const Vec3 across = axis.unitOrthogonal();
      const Turn turn{axis, across, axis.cross(across), script_.turn, 1.0 + 1.5 * path.uniform()};
      for (long k = 0; k < turning; ++k)
        sample([&](double t) { return turn.rate(t); }, dt * static_cast<double>(k));
    }
    if (means_) say_mean_rates(recording_);
    return recording_;
  }

 private:
  template <class RateOf>
  void sample(const RateOf& rate, double begin) {
    constexpr int parts = 10;
    constexpr double h = dt / parts;
    const double gauss = h / std::sqrt(12.0);
    Vec3 turning = Vec3::Zero(), force = Vec3::Zero();
    for (int part = 0; part < parts; ++part) {
      const double middle = begin + h * (part + 0.5);
      const Vec3 a = rate(middle - gauss), b = rate(middle + gauss);
      const Mat3 half_way = R_lc_ * rotation(Vec3(0.5 * h * rate(middle)));
      turning += (0.5 * (a + b) + half_way.transpose() * script_.omega_ie_l) / parts;
      force += half_way.transpose() * Vec3::UnitZ() / parts;
      R_lc_ =
          R_lc_ * rotation(Vec3(0.5 * h * (a + b) + std::sqrt(3.0) / 12.0 * h * h * a.cross(b)));
    }
    if (!means_) {
      turning = rate(begin + dt) + R_lc_.transpose() * script_.omega_ie_l;
      force = R_lc_.transpose() * Vec3::UnitZ();
    }
    const Vec3 gyro = test::gyro_output(sensors(), turning, force),
               acc = test::accelerometer_output(sensors(), force);
    recording_.channels[0].values.push_back(dt * static_cast<double>(++samples_));
    for (int i = 0; i < 3; ++i) {
      recording_.channels[1 + i].values.push_back(gyro[i] + script_.gyro_noise * noise_.normal());
      recording_.channels[4 + i].values.push_back(acc[i] + script_.acc_noise * noise_.normal());
    }
  }

  test::StrapdownScript script_;
  bool means_;
  Recording recording_;
  Stream noise_{script_.seed, 0, Purpose::test, 1};
  Mat3 R_lc_ = Mat3::Identity();
  long samples_ = 0;
};

/// Errors of the three scale factors in their own sigmas, and the root mean square of all errors.
struct Errors {
  Vec3 scale = Vec3::Zero();
  double rms = 0.0, chi2_per_dof = 0.0;
};

Errors errors_of(const Signals& signals) {
  const Unit u = unit_of(signals);
  const FilterSpec filter = filter_for(u.test, std::max(10.0 * u.compass.sigma, 2e-3));
  const BatchResult fit = fit_batch(filter, {u.test.timeline, u.test.readout, u.test.measured},
                                    make_layout(filter).theta);
  EXPECT_EQ(fit.estimate.status, EstimateStatus::ok);
  Errors out;
  double squares = 0.0;
  int scales = 0;
  for (const ParameterEstimate& p : fit.estimate.parameters) {
    const double z = (p.value - as_platform(p.param, sensors())) / p.sigma;
    squares += z * z;
    if (TermLibrary::specs[p.param].group.view() == "s") out.scale[scales++] = z;
  }
  EXPECT_EQ(scales, 3);
  out.rms = std::sqrt(squares / static_cast<double>(fit.estimate.parameters.size()));
  out.chi2_per_dof = fit.estimate.statistic_per_dof();
  return out;
}

/// What is said to be what it is is estimated within its sigmas; taken for the other kind it makes
/// scale factors that are off by many, and nothing in the fit shows it.
void expect_told(SampleKind kind) {
  Signals signals = signals_of(Wobbling(script(201), kind).recording());
  ASSERT_EQ(signals.means, kind == SampleKind::mean_rates);
  const Errors right = errors_of(signals);
  EXPECT_LT(right.scale.cwiseAbs().maxCoeff(), 3.5);
  EXPECT_LT(right.rms, 1.5);
  signals.means = !signals.means;
  const Errors wrong = errors_of(signals);
  EXPECT_GT(wrong.scale.cwiseAbs().minCoeff(), 4.5);
  EXPECT_NEAR(wrong.chi2_per_dof, right.chi2_per_dof, 0.02);
}

TEST(MeanRates, OfAUnitThatWobblesGiveItsScaleFactors) {
  expect_told(SampleKind::mean_rates);
}

TEST(Instants, OfAUnitThatWobblesGiveItsScaleFactors) {
  expect_told(SampleKind::rates);
}

}  // namespace
}  // namespace drift::strapdown::mean_rates_test
