#include "core/estimate/strapdown/case_test.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/estimate/batch.hpp"
#include "core/estimate/sequential/iterated_ekf.hpp"
#include "core/estimate/strapdown/gyrocompass.hpp"
#include "core/estimate/strapdown/turn_reading.hpp"
#include "core/sim/predict.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::case_test_test {
namespace {

using test::set;

constexpr Site site{0.6, 9.8};

/// A navigation-grade unit; the sensors' convention.
Theta sensors() {
  Theta theta = Theta::Zero();
  for (const auto& [key, value] : std::initializer_list<std::pair<const char*, double>>{
           {"D_F_x", 0.1}, {"D_F_y", -0.2}, {"D_F_z", 0.3}, {"s_x", 40},   {"s_y", -25},
           {"s_z", 60},    {"eta_x", 30},   {"eta_y", -45}, {"eta_z", 20}, {"xi_x", 15},
           {"xi_y", 50},   {"xi_z", -35},   {"K0_x", 40},   {"K0_y", -60}, {"K0_z", 25},
           {"K1_x", 50},   {"K1_y", -30},   {"K1_z", 70},   {"dO_y", 20},  {"dP_z", -30},
           {"dO_z", 10}})
    set(theta, key, value);
  return theta;
}

test::StrapdownScript script(std::uint64_t seed) {
  test::StrapdownScript s;
  s.dwells = 16;
  s.rest = 20.0;
  s.turn = 8.0;
  s.gyro_noise = 3e-6;
  s.acc_noise = 1e-4;
  s.omega_ie_l = site.omega_ie_l();
  s.seed = seed;
  return s;
}

FilterSpec filter_for(const CaseTest& test, double attitude) {
  FilterSpec f;
  f.coupling = Coupling::eq6;  // of a platform that is told what its gyros read
  for (const char* group : {"D_F", "s", "eta", "xi", "K0", "K1", "dP", "dO"})
    for (std::size_t p = 0; p < TermLibrary::num_params; ++p)
      if (TermLibrary::specs[p].group.view() == group) {
        f.active.set(p);
        f.priors[p] = TermLibrary::specs[p].prior_si();
      }
  for (const std::size_t p : zero_by_definition) f.priors[p] = fixed(0.0);
  f.initial_attitude = attitude;
  f.noise.angle_random_walk = test.angle_random_walk;
  return f;
}

struct Unit {
  CaseTest test;
  Gyrocompass compass;
};

Unit unit_of(const test::StrapdownScript& script, const Theta& theta = sensors(),
             InTurns in_turns = InTurns::left_out) {
  const Signals signals = signals_of(strapdown_recording(script, theta));
  const auto dwells = find_dwells(signals, {}).dwells;
  Unit u;
  std::vector<double> azimuth;
  for (int round = 0; round < 3; ++round) {
    u.test = lay_out_case(signals, dwells, site, Carry::through, azimuth, in_turns);
    u.compass = gyrocompass(u.test, azimuth, 1.0 * unit::deg_per_h.to_si);
    azimuth = u.compass.azimuth;
  }
  return u;
}

/// The platform's parameters that stand for the sensors' (case_test.hpp).
double as_platform(std::size_t param, const Theta& sensors) {
  const double value = sensors[static_cast<Eigen::Index>(param)];
  return TermLibrary::specs[param].group.view() == "s" ? 1.0 / (1.0 + value) - 1.0 : value;
}

}  // namespace

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

/// Of 8 units whose accelerometers sit centimetres apart and lag by a millisecond: errors of both
/// in their own sigmas. 80 of them would have an rms of 1 +- 0.08.
TEST(CaseTest, LeverArmsAndDelayAreFoundWhereTurnsAreRead) {
  Theta theta = sensors();
  std::vector<std::size_t> wanted;
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, double>>{{"arm_x_x", 1.0},
                                                             {"arm_y_x", -2.0},
                                                             {"arm_z_x", 3.0},
                                                             {"arm_x_y", 4.0},
                                                             {"arm_y_y", 5.0},
                                                             {"arm_z_y", -6.0},
                                                             {"arm_x_z", 0.0},
                                                             {"arm_y_z", 2.0},
                                                             {"arm_z_z", 1.0},
                                                             {"acc_delay", 1.0}}) {
    set(theta, key, value);
    wanted.push_back(*TermLibrary::find(key));
  }
  double squares = 0.0, chi2 = 0.0, measured = 0.0;
  for (std::uint64_t seed = 201; seed <= 208; ++seed) {
    const Unit u = unit_of(script(seed), theta, InTurns::read);
    ASSERT_TRUE(u.test.timeline.reads_turns);
    FilterSpec filter = filter_for(u.test, std::max(10.0 * u.compass.sigma, 2e-3));
    for (const std::size_t p : wanted) {
      filter.active.set(p);
      filter.priors[p] = TermLibrary::specs[p].prior_si();
    }
    const BatchResult fit = fit_batch(filter, {u.test.timeline, u.test.readout, u.test.measured},
                                      make_layout(filter).theta);
    ASSERT_EQ(fit.estimate.status, EstimateStatus::ok);
    chi2 += fit.estimate.statistic;
    measured += static_cast<double>(fit.estimate.measured);
    for (const std::size_t p : wanted) {
      const ParameterEstimate& found = *fit.estimate.find(p);
      const double z = (found.value - theta[static_cast<Eigen::Index>(p)]) / found.sigma;
      EXPECT_LT(std::abs(z), 4.5) << TermLibrary::specs[p].key.view() << ", seed " << seed;
      EXPECT_LT(found.learning_ratio(), 0.05) << TermLibrary::specs[p].key.view();
      squares += z * z;
    }
  }
  EXPECT_GT(std::sqrt(squares / 80.0), 0.8);
  EXPECT_LT(std::sqrt(squares / 80.0), 1.25);
  EXPECT_NEAR(chi2 / measured, 1.0, 0.05);
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
  const double whole = 0.5 * length * length;
  Vec3 even = Vec3::Zero();
  constexpr int steps = 1000;
  for (int k = 0; k < steps; ++k)
    even += rotation(Vec3(-whole * (k + 0.5) / steps * axis)) * f0 / steps;
  EXPECT_LT((read.acc - even).norm(), 2e-7);
  EXPECT_GT((s.acc[100] - even).norm(), 1e-2);  // what the correction is of
  EXPECT_LT((read.turn.rate - 0.5 * length * axis).norm(), 1e-12);
  const Mat3 expected = (skew(axis) + length * length / 3.0 * skew(axis) * skew(axis)) / gravity;
  EXPECT_LT((read.turn.arm - expected).norm(), 1e-5);
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
  IteratedEkf iterated(filter, u.test.timeline, u.test.readout, start);
  iterated.run(u.test.measured, start);
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
  const double earth = std::sqrt(2.0 / 3.0) * site.omega_ie_l().head<2>().norm();
  EXPECT_NEAR(t.readout.gimbal_noise, earth, 0.01 * earth);
  EXPECT_EQ((t.measured.gimbal.array() == 0.0).count(), 3 * 16);
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

TEST(Gyrocompass, OneRestKnowsNorthAsWellAsThePriorOfItsDrift) {
  test::StrapdownScript one = script(7);
  one.dwells = 1;
  one.rest = 600.0;
  const Unit u = unit_of(one);
  ASSERT_TRUE(u.compass.sees_earth);
  const double horizontal = site.omega_ie_l()[0];
  EXPECT_NEAR(u.compass.sigma, unit::deg_per_h.to_si / horizontal, 0.01);
}

TEST(Gyrocompass, GyrosOfAPhoneSeeNoEarth) {
  test::StrapdownScript coarse = script(8);
  coarse.gyro_noise = 0.002;
  Theta theta = sensors();
  set(theta, "D_F_x", 900.0);
  set(theta, "D_F_y", -2500.0);
  const Signals signals = signals_of(strapdown_recording(coarse, theta));
  const CaseTest t = lay_out_case(signals, find_dwells(signals, {}).dwells, site, Carry::through);
  EXPECT_FALSE(gyrocompass(t, {}, unit::deg_per_h.to_si).sees_earth);
}

}  // namespace drift::strapdown::case_test_test
