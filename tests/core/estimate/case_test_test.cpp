#include "core/estimate/strapdown/case_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/estimate/batch.hpp"
#include "core/estimate/sequential/iterated_passes.hpp"
#include "core/estimate/strapdown/gyrocompass.hpp"
#include "core/estimate/strapdown/unknown_north.hpp"
#include "core/sim/predict.hpp"
#include "tests/support/case_unit.hpp"

namespace drift::strapdown::case_test_test {
using namespace case_unit;

TEST(CaseTest, RestsAndWaysAreLaidOutAndTheGyrosFindNorth) {
  const Unit u = unit_of(script(1));
  EXPECT_EQ(u.test.timeline.positions, 16);
  EXPECT_EQ(u.test.timeline.chains, 1);
  EXPECT_EQ(u.test.ways.size(), 15u);
  EXPECT_TRUE(u.compass.sees_earth);
  // The case starts as the local axes; misalignment turns what the gyros see by 50 arcsec.
  EXPECT_NEAR(std::remainder(u.compass.azimuth[0], 2.0 * M_PI), 0.0,
              5.0 * u.compass.sigma + 60.0 * unit::arcsec.to_si);
  for (std::size_t i = 1; i < u.test.timeline.intervals.size(); ++i)
    EXPECT_NEAR(u.test.timeline.intervals[i].t0, u.test.timeline.intervals[i - 1].t1, 1e-9);
  // White noise of one sample, averaged over a row.
  EXPECT_NEAR(u.test.readout.accelerometer_noise, 1e-4 / std::sqrt(u.test.row / 0.01), 5e-7);
  EXPECT_NEAR(u.test.angle_random_walk, 3e-6 * std::sqrt(0.01), 3e-8);
}

/// Closed form: the case rests, speeds up evenly to 10 deg/s, turns, slows down and rests again.
TEST(CaseTest, RowsOnTheWayKnowTheSquareOfTheRate) {
  constexpr double fastest = 10.0 * drift::detail::deg, ramp = 0.5, even = 4.0, rest = 5.0;
  Signals signals;
  signals.interval = 0.01;
  const int samples = static_cast<int>(std::lround((2.0 * rest + 2.0 * ramp + even) / 0.01));
  for (int k = 1; k <= samples; ++k) {
    const double t = 0.01 * k, on = t - rest, left = rest + 2.0 * ramp + even - t;
    signals.time.push_back(t);
    signals.gyro.push_back(fastest * std::clamp(std::min(on, left) / ramp, 0.0, 1.0) *
                           Vec3::UnitZ());
    signals.acc.push_back(Vec3::UnitZ());
  }
  const CaseTest test =
      lay_out_case(signals, find_dwells(signals, {}).dwells, site, Carry::through);
  double angle = 0.0, square = 0.0;
  for (const Interval& i : test.timeline.intervals) {
    if (!i.slew) continue;
    angle += i.length() * i.omega_cmd_p.z();
    square += i.length() * i.omega_cmd_p.squaredNorm();
  }
  EXPECT_NEAR(angle, fastest * (even + ramp), 1e-9);
  // Each row on a ramp lacks the variance of its rates.
  const double lacks = largest_change * largest_change / 12.0 * 2.0 * ramp;
  EXPECT_NEAR(square / (fastest * fastest), even + 2.0 * ramp / 3.0, lacks);
}

/// Second implementation: what the rows say of a small change is what the prediction does.
TEST(CaseTest, RowsAreTheDerivativesOfThePrediction) {
  const Unit u = unit_of(script(2));
  const FilterSpec filter = filter_for(u.test, 0.01);
  const Layout layout = make_layout(filter);
  const DriftModel model = filter.model();
  const MeasuredTest measured{u.test.timeline, u.test.readout, u.test.measured};
  const std::vector<Vec3> psi0{Vec3::Zero()};
  Theta theta = layout.theta;
  for (const std::size_t p : layout.params) theta[p] = as_platform(p, sensors());
  Trajectory phi;
  const Measurements at = predict(u.test.timeline, model, theta, psi0, u.test.readout, &phi);
  const auto rows =
      measurement_equations(measured, model, layout, theta, phi, filter.initial_attitude);
  // Every row that is measured: three accelerometers, then three gyros.
  const auto stacked = [&](const Measurements& m) {
    std::vector<double> all;
    for (Eigen::Index i = 0; i < m.acc.cols(); ++i) {
      if (!u.test.timeline.intervals[static_cast<std::size_t>(i)].rest) continue;
      for (int a = 0; a < 3; ++a) all.push_back(m.acc(a, i) / u.test.readout.accelerometer_noise);
      for (int a = 0; a < 3; ++a) all.push_back(m.gimbal(a, i) / u.test.readout.gimbal_noise);
    }
    return Eigen::Map<const VecX>(all.data(), static_cast<Eigen::Index>(all.size())).eval();
  };
  const VecX base = stacked(at);
  ASSERT_EQ(rows.front().rows.rows(), base.size());
  const auto compare = [&](const Measurements& moved, double step, Eigen::Index column,
                           std::string_view what) {
    const VecX change = (stacked(moved) - base) / step;
    const VecX row = rows.front().rows.col(column);
    // Second order in the step.
    EXPECT_LT((change - row).norm(), 2e-3 * row.norm() + 1e-6) << what;
  };
  for (std::size_t k = 0; k < layout.size(); ++k) {
    Theta moved = theta;
    constexpr double step = 0.02;
    moved[layout.params[k]] += step * layout.sigma[static_cast<Eigen::Index>(k)];
    compare(predict(u.test.timeline, model, moved, psi0, u.test.readout), step,
            static_cast<Eigen::Index>(3 + k), TermLibrary::specs[layout.params[k]].key.view());
  }
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Vec3> moved = psi0;
    constexpr double step = 0.01;
    moved[0][axis] += step * filter.initial_attitude;
    compare(predict(u.test.timeline, model, theta, moved, u.test.readout), step, axis, "attitude");
  }
}

/// Second implementation: the filter that carries a covariance, and the fit that whitens its rows.
TEST(CaseTest, IteratedFilterAndBatchAgreeWithRandomWalk) {
  const Unit u = unit_of(script(3));
  FilterSpec filter = filter_for(u.test, 0.01);
  filter.noise.angle_random_walk *= 5.0;  // so that it counts
  const MeasuredTest measured{u.test.timeline, u.test.readout, u.test.measured};
  const Theta start = make_layout(filter).theta;
  const BatchResult batch = fit_batch(filter, measured, start);
  ASSERT_EQ(batch.estimate.status, EstimateStatus::ok);
  IteratedPasses ekf(filter, u.test.timeline, u.test.readout, start);
  const FilterEstimate& iterated = ekf.run(u.test.measured, start);
  ASSERT_EQ(iterated.status(), EstimateStatus::ok);
  for (std::size_t k = 0; k < batch.estimate.parameters.size(); ++k) {
    const ParameterEstimate& b = batch.estimate.parameters[k];
    const std::string_view key = TermLibrary::specs[b.param].key.view();
    EXPECT_NEAR(iterated.theta()[static_cast<Eigen::Index>(b.param)], b.value, 0.02 * b.sigma)
        << key;
    EXPECT_NEAR(iterated.sigma(k) / b.sigma, 1.0, 2e-3) << key;
  }
}

/// Of 8 units with noise of their own: errors in their own sigmas. 168 of them would have an rms of
/// 1 +- 0.055, were they independent.
TEST(CaseTest, ErrorsOfEightUnitsAreAsLargeAsTheirSigmas) {
  double squares = 0.0, count = 0.0, worst = 0.0;
  for (std::uint64_t seed = 101; seed <= 108; ++seed) {
    const Unit u = unit_of(script(seed));
    const FilterSpec filter = filter_for(u.test, std::max(10.0 * u.compass.sigma, 2e-3));
    const BatchResult fit = fit_batch(filter, {u.test.timeline, u.test.readout, u.test.measured},
                                      make_layout(filter).theta);
    ASSERT_EQ(fit.estimate.status, EstimateStatus::ok);
    for (const ParameterEstimate& p : fit.estimate.parameters) {
      const double z = (p.value - as_platform(p.param, sensors())) / p.sigma;
      squares += z * z;
      count += 1.0;
      worst = std::max(worst, std::abs(z));
    }
  }
  EXPECT_GT(std::sqrt(squares / count), 0.8);
  EXPECT_LT(std::sqrt(squares / count), 1.25);
  EXPECT_LT(worst, 4.5);
}

TEST(CaseTest, OneWayAtATimeMakesAChainOfEach) {
  const Signals signals = signals_of(strapdown_recording(script(5), sensors()));
  const auto dwells = find_dwells(signals, {}).dwells;
  const CaseTest t = lay_out_case(signals, dwells, site, Carry::one_way);
  EXPECT_EQ(t.timeline.chains, 15);
  std::size_t at_rest = 0;
  for (const Interval& i : t.timeline.intervals) at_rest += i.rest;
  EXPECT_EQ(at_rest, 32u);  // two halves of each dwell
}

/// Held in the hand a unit does not rest to its gyros.
TEST(CaseTest, InADwellThatIsNoRestTheGyrosCarryTheAttitude) {
  test::StrapdownScript shaken = script(9);
  shaken.dwells = 8;
  Recording recording = strapdown_recording(shaken, sensors());
  // The fourth dwell, from 84 s on: the gyros scatter ten times as much.
  Stream hand(1, 0, Purpose::test, 5);
  for (std::size_t k = 8400; k < 10400; ++k)
    for (int a = 0; a < 3; ++a) recording.channels[1 + a].values[k] += 3e-5 * hand.normal();
  const Signals signals = signals_of(recording);
  const auto dwells = find_dwells(signals, {}).dwells;
  ASSERT_EQ(dwells.size(), 8u);
  const CaseTest t = lay_out_case(signals, dwells, site, Carry::one_way);
  EXPECT_EQ(t.still, (std::vector<bool>{true, true, true, false, true, true, true, true}));
  EXPECT_EQ(t.timeline.chains, 7);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < t.timeline.intervals.size(); ++i) {
    const Interval& row = t.timeline.intervals[i];
    const auto column = static_cast<Eigen::Index>(i);
    EXPECT_EQ(t.measured.acc.col(column).array().isFinite().all(), !row.slew);
    if (row.position != 3 || row.slew) continue;
    ++seen;
    EXPECT_FALSE(row.rest);
    EXPECT_FALSE(t.measured.gimbal.col(column).array().isFinite().any());
  }
  EXPECT_GE(seen, 16u);  // rows of a second
}

/// A gyro is read once in a dwell, and what its halves differ by is its noise, with the Earth's.
TEST(CaseTest, TheNoiseOfAStillDwellIsThatOfItsHalves) {
  const CaseTest t = [] {
    const Signals signals = signals_of(strapdown_recording(script(10), sensors()));
    return lay_out_case(signals, find_dwells(signals, {}).dwells, site, Carry::one_way);
  }();
  const double half = t.row / 0.01;  // samples
  EXPECT_NEAR(t.readout.accelerometer_noise, 1e-4 / std::sqrt(half), 0.25e-4 / std::sqrt(half));
  // Of these gyros it is the unknown North.
  const double earth = std::sqrt(unknown_north(t.timeline, Vec3::Zero()).variance);
  EXPECT_NEAR(t.readout.gimbal_noise, earth, 0.01 * earth);
  EXPECT_EQ((t.measured.gimbal.array() == 0.0).count(), 3 * 16);
}

/// Quarter turns leave a third of a vector where it was: dwells that are alike by 1/3 know half as
/// much, and a dwell and its way are one.
TEST(UnknownNorth, IsTwoThirdsOfItsSquareTimesWhatNeighboursHaveInCommon) {
  Timeline timeline;
  timeline.site = site;
  const double north = site.omega_ie_l().head<2>().norm();
  EXPECT_NEAR(unknown_north(timeline, Vec3::Zero()).variance, 2.0 / 3.0 * north * north,
              1e-12 * north * north);
  const Vec3 drift(1e-3, -2e-3, 3e-3);
  for (const auto& [position, seconds] : {std::pair{1, 2.0}, {2, 4.0}})
    for (int part = 0; part < 2; ++part) {
      Interval i;
      i.t1 = 0.5 * seconds;
      i.position = position;
      i.slew = true;
      i.omega_cmd_p = drift + Vec3(0.0, 90.0 * detail::deg / seconds, 0.0);
      timeline.intervals.push_back(i);
    }
  const UnknownNorth found = unknown_north(timeline, drift);
  EXPECT_NEAR(found.variance, 4.0 / 3.0 * north * north, 1e-12 * north * north);
  EXPECT_NEAR(found.walk, found.variance * (4.0 + 16.0) / 6.0, 1e-12 * found.walk);
}

TEST(CaseTest, AGapOnTheWayBeginsANewChain) {
  Recording recording = strapdown_recording(script(6), sensors());
  // One second of the third way is lost.
  const std::size_t first = 7800;
  for (Channel& c : recording.channels)
    c.values.erase(c.values.begin() + first, c.values.begin() + first + 100);
  recording.lines.resize(recording.rows());
  const Signals signals = signals_of(recording);
  const auto dwells = find_dwells(signals, {}).dwells;
  const CaseTest t = lay_out_case(signals, dwells, site, Carry::through);
  EXPECT_EQ(t.timeline.chains, 2);
  EXPECT_EQ(t.ways_with_gap, 1u);
}

}  // namespace drift::strapdown::case_test_test
