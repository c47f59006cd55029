// The platform in motion: geometry of physics.md 1.4, servo against the reduced models, two
// integrators.
#include <gtest/gtest.h>

#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::dynamics_test {
namespace {

using namespace drift::test;

/// Truth of given parameters alone, no noise, no initial error.
Simulation perfect_run(Coupling coupling, const Timeline& timeline, const Theta& theta,
                       const OdeOptions& options, const ServoOptions& servo = {}) {
  TruthSpec truth = base_truth(coupling);
  truth.active.set(param("lambda"));
  truth.servo = servo;
  Readout readout;
  readout.accelerometer_noise = readout.gimbal_noise = 0.0;
  const TruthDraw draw{theta, std::vector<Vec3>(timeline.chains, Vec3::Zero())};
  return Simulator(truth, readout, options).run(timeline, draw, 1, 0);
}

Simulation perfect_run(Coupling coupling, const Timeline& timeline, const Theta& theta) {
  return perfect_run(coupling, timeline, theta, Simulator::default_options(coupling));
}

/// Attitude error of the platform against its reference at the end, local axes [arcsec].
Vec3 final_error(const Timeline& timeline, const Simulation& sim) {
  return timeline.nodes.back().R_lr * sim.phi.back() / arcsec;
}

/// Error that a slew of `angle` about the platform's x axis leaves, x up, z gyro tilted 100 arcsec
/// toward x (E_zx), in platform axes before the slew [arcsec].
Vec3 slew_error(Coupling coupling, double angle) {
  std::string why;
  const Mat3 R_lp = parse_axes("x=U y=N z=W", why).value();
  Site site;
  site.latitude = 90.0 * detail::deg;
  Timeline timeline;
  // One slew by hand: the geometry needs no gimbals.
  timeline.site = site;
  timeline.chains = 1;
  timeline.positions = 1;
  const double rate = 0.5 * detail::deg;
  const int n = static_cast<int>(std::lround(angle / rate / 10.0));
  for (int k = 0; k < n; ++k) {
    Interval i;
    i.t0 = 10.0 * k;
    i.t1 = i.t0 + 10.0;
    i.cage = k == 0;
    i.slew = true;
    i.omega_cmd_p = Vec3(rate, 0.0, 0.0);
    timeline.intervals.push_back(i);
  }
  place_nodes(timeline, {R_lp});
  Theta theta = Theta::Zero();
  theta[param("xi_z")] = 100.0 * arcsec;  // z gyro: output axis is x
  const Simulation sim = perfect_run(coupling, timeline, theta);
  EXPECT_TRUE(sim.ode.ok()) << sim.ode.cause;
  return R_lp.transpose() * final_error(timeline, sim);  // Earth rate is along x (Up) at the pole
}

TEST(Slew, UnderEquation6TheNetErrorIsSineAndOneMinusCosine) {
  // Rotation about the dual axis e_x - E_zx e_z: error E (sin T, 1 - cos T) across the axis
  // (physics.md 1.4); Earth rate during the slew adds E Omega T, 100" x 15 deg/h x 180 s = 1.3".
  const Vec3 quarter = slew_error(Coupling::eq6, 90.0 * detail::deg);
  EXPECT_NEAR(std::hypot(quarter.y(), quarter.z()), 141.4, 1.5);
  const Vec3 half = slew_error(Coupling::eq6, 180.0 * detail::deg);
  EXPECT_NEAR(std::hypot(half.y(), half.z()), 200.0, 2.6);
  const Vec3 full = slew_error(Coupling::eq6, 360.0 * detail::deg);
  EXPECT_LT(std::hypot(full.y(), full.z()), 6.0);
}

TEST(Slew, UnderEquation5ASlewFeelsOnlyEarthRate) {
  const Vec3 quarter = slew_error(Coupling::eq5, 90.0 * detail::deg);
  EXPECT_LT(quarter.norm(), 1.4);  // E Omega T = 100" x 15.04 deg/h x 180 s = 1.31"
}

/// Error after turns of the case about Up at 1 deg/s, platform free, z up, x gyro tilted 100 arcsec
/// toward z [arcsec].
double spin_error(Coupling coupling, double lambda, int turns) {
  Timeline timeline;
  timeline.site = harbin;
  timeline.chains = timeline.positions = 1;
  for (int k = 0; k < 36 * turns; ++k) {
    Interval i;
    i.t0 = 10.0 * k;
    i.t1 = i.t0 + 10.0;
    i.cage = k == 0;
    i.heading0 = i.t0 * detail::deg;
    i.heading1 = i.t1 * detail::deg;
    timeline.intervals.push_back(i);
  }
  place_nodes(timeline, {Mat3::Identity()});
  Theta theta = Theta::Zero();
  theta[param("eta_x")] = 100.0 * arcsec;
  theta[param("lambda")] = lambda;
  const Simulation sim = perfect_run(coupling, timeline, theta);
  EXPECT_TRUE(sim.ode.ok());
  return final_error(timeline, sim).norm();
}

TEST(CaseSpin, DragsThePlatformUnderEquation5ByTwoPiPerTurn) {
  // 100" x (2 pi n + Omega sin(latitude) t): 628.3" and 1.88" of Earth rate per turn of 360 s. The
  // vertical leaves z_p by 15 deg/h t, 4.5 deg after three turns: cosine below 0.3 %.
  EXPECT_NEAR(spin_error(Coupling::eq5, 0.0, 1), 630.2, 0.2);
  EXPECT_NEAR(spin_error(Coupling::eq5, 0.0, 3), 1890.6, 2.5);
  EXPECT_NEAR(spin_error(Coupling::lambda, 0.5, 1), 315.1, 0.2);
}

TEST(CaseSpin, LeavesThePlatformAloneUnderEquation6) {
  EXPECT_LT(spin_error(Coupling::eq6, 1.0, 3), 1e-9);
}

/// The demonstration of physics.md 1.5: 12 positions, 11 torqued slews, 12.5 h.
struct Demonstration {
  Timeline timeline = preset_timeline("slew12", CommandLaw::level);
  Theta theta = Theta::Zero();
  Demonstration() {
    const auto set = [&](const char* key, double value) {
      const auto i = param(key);
      theta[i] = value * TermLibrary::specs[i].unit.to_si;
    };
    set("eta_x", 112), set("xi_x", -60), set("eta_y", 80), set("xi_z", 30);
    set("D_F_x", 0.5), set("D_F_y", -0.3), set("D_F_z", 0.8);
    set("D_I_x", 0.7), set("D_I_y", -1.1), set("D_I_z", 1.45);
    set("D_S_x", 0.33), set("D_S_y", 0.6), set("D_S_z", -0.4);
  }
};

TEST(Servo, FirstPrinciplesLoopIsEquation6AndNotEquation5) {
  const Demonstration d;
  OdeOptions tight = Simulator::default_options(Coupling::servo);
  tight.rel_tol = 1e-10;
  const Simulation servo = perfect_run(Coupling::servo, d.timeline, d.theta, tight);
  ASSERT_TRUE(servo.ode.ok()) << servo.ode.cause;
  const Simulation eq6 = perfect_run(Coupling::eq6, d.timeline, d.theta);
  const Simulation eq5 = perfect_run(Coupling::eq5, d.timeline, d.theta);
  EXPECT_LT((final_error(d.timeline, servo) - final_error(d.timeline, eq6)).norm(), 1e-3);
  EXPECT_GT((final_error(d.timeline, servo) - final_error(d.timeline, eq5)).norm(), 100.0);
}

TEST(Servo, ConstantTorquesHangThePlatformOffWithoutDrift) {
  // 1e-2 N m at K = 200 N m/rad and H/c = 1: 10.3 arcsec, an offset that does not grow.
  PlanDefaults defaults;
  defaults.mode = CommandLaw::level;
  defaults.dwell = 600.0;
  const Timeline timeline = lay_out(preset_plan("six", defaults).value(), harbin);
  ServoOptions torque;
  torque.constant_torque = Vec3(1e-2, 0.0, 0.0);
  const auto options = Simulator::default_options(Coupling::servo);
  const Simulation with = perfect_run(Coupling::servo, timeline, Theta::Zero(), options, torque);
  const Simulation without = perfect_run(Coupling::servo, timeline, Theta::Zero(), options);
  ASSERT_TRUE(with.ode.ok() && without.ode.ok());
  // The loop starts at rest with its torque, so the attitude shows nothing at all.
  EXPECT_LT((final_error(timeline, with) - final_error(timeline, without)).norm(), 0.01);
}

TEST(Servo, BaseMotionIsIsolated) {
  // 5 arcsec of base motion at 0.2 Hz, far inside a loop of 20 Hz: the platform does not follow.
  PlanDefaults defaults;
  defaults.mode = CommandLaw::level;
  defaults.dwell = 120.0;
  defaults.sample = 10.0;
  const Timeline timeline = lay_out(preset_plan("six", defaults).value(), harbin);
  ServoOptions shaken;
  shaken.base_amplitude = 5.0 * arcsec;
  shaken.base_frequency = 0.2;
  const Simulation sim = perfect_run(Coupling::servo, timeline, Theta::Zero(),
                                     Simulator::default_options(Coupling::servo), shaken);
  ASSERT_TRUE(sim.ode.ok()) << sim.ode.cause;
  for (const Vec3& phi : sim.phi) EXPECT_LT(phi.norm() / arcsec, 0.01);
}

TEST(ReducedModel, HoldsItsAccuracyAtModestTolerance) {
  const Demonstration d;
  for (const Coupling coupling : {Coupling::eq5, Coupling::eq6}) {
    OdeOptions reference, modest;
    reference.rel_tol = 1e-12;
    reference.abs_tol = 1e-15;
    modest.rel_tol = 1e-8;
    modest.abs_tol = 1e-13;
    const Simulation a = perfect_run(coupling, d.timeline, d.theta, reference);
    const Simulation b = perfect_run(coupling, d.timeline, d.theta, modest);
    ASSERT_TRUE(a.ode.ok() && b.ode.ok());
    double worst = 0.0;
    for (std::size_t k = 0; k < a.phi.size(); ++k)
      worst = std::max(worst, (a.phi[k] - b.phi[k]).norm());
    EXPECT_LT(worst / arcsec, 0.004);  // physics.md 6.2
  }
}

TEST(ReducedModel, TwoIntegratorsAgree) {
  // CVODE against fixed-step Runge-Kutta: dwells to 1e-5 arcsec, slews (steps of up to 0.05 rad,
  // fourth order) to 1e-4 arcsec; both far below any noise.
  for (const auto& [preset, bound] :
       {std::pair{"six", 1e-5}, {"eighteen", 1e-5}, {"slew12", 1e-4}, {"casespin", 1e-4}}) {
    const Timeline timeline = preset_timeline(preset, CommandLaw::free);
    for (const Coupling coupling : {Coupling::eq5, Coupling::eq6}) {
      const Theta theta = random_theta(8);
      const Simulation cvode = perfect_run(coupling, timeline, theta);
      ASSERT_TRUE(cvode.ode.ok());
      DriftModel model = base_truth(coupling).model();
      const Trajectory fixed_step =
          integrate_fixed(timeline, model, theta, std::vector<Vec3>(timeline.chains, Vec3::Zero()));
      double worst = 0.0;
      for (std::size_t k = 0; k < fixed_step.size(); ++k)
        worst = std::max(worst, (fixed_step[k] - cvode.phi[k]).norm());
      EXPECT_LT(worst / arcsec, bound) << preset;
    }
  }
}

TEST(FreePlatform, HoldsInertialSpaceWithoutErrors) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free);
  const Simulation sim = perfect_run(Coupling::eq5, timeline, Theta::Zero());
  for (const Vec3& phi : sim.phi) EXPECT_LT(phi.norm(), 1e-15);
  // After an hour the local axes have turned by Omega t against it.
  const Interval& last_of_first = timeline.intervals[59];
  const Mat3 turned =
      timeline.nodes[0].R_lr.transpose() * timeline.nodes[last_of_first.last_node()].R_lr;
  EXPECT_NEAR(rotation_vector(turned).norm(), 7.292115e-5 * 3600.0, 1e-12);
}

TEST(Recording, AccelerometersAtRestReadOneGOnTheAxisThatPointsUp) {
  const Timeline timeline = preset_timeline("six", CommandLaw::level);
  const Simulation sim = perfect_run(Coupling::eq6, timeline, Theta::Zero());
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const int p = timeline.intervals[i].position;
    Vec3 expected = Vec3::Zero();
    expected[p / 2] = p % 2 == 0 ? 1.0 : -1.0;
    EXPECT_LT((sim.measured.acc.col(i) - expected).norm(), 1e-12);
  }
}

TEST(Recording, EveryParameterThatReachesTheModelReachesTheRecording) {
  // Perturbing a drawn value changes the data (the class of silent bug in which dispersions are not
  // applied). Commands and 45-deg attitudes are needed for some, so: eighteen, level.
  const Timeline timeline = preset_timeline("eighteen", CommandLaw::level, 600.0);
  const Theta theta = random_theta(3);
  const Simulation nominal = perfect_run(Coupling::eq5, timeline, theta);
  ParamMask known = base_parameters();
  known.set(param("lambda"));
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    if (!known[i]) continue;  // the others: predict_test.cpp
    Theta other = theta;
    other[i] += TermLibrary::specs[i].prior_si().sigma();
    const Coupling coupling = i == param("lambda") ? Coupling::lambda : Coupling::eq5;
    const Simulation base =
        coupling == Coupling::eq5 ? nominal : perfect_run(coupling, timeline, theta);
    const Simulation changed = perfect_run(coupling, timeline, other);
    const double difference = (changed.measured.acc - base.measured.acc).norm() +
                              (changed.measured.gimbal - base.measured.gimbal).norm();
    EXPECT_GT(difference, 1e-9) << TermLibrary::specs[i].key.view();
  }
}

TEST(Simulation, IsAPureFunctionOfSeedAndRun) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 600.0);
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.noise.angle_random_walk = 1e-3 * detail::deg / 60.0;
  Simulator simulator(truth, Readout{});
  const Simulation third = simulator.run(timeline, 7, 3);
  simulator.run(timeline, 7, 4);
  const Simulation again = simulator.run(timeline, 7, 3);
  const Simulation fresh = Simulator(truth, Readout{}).run(timeline, 7, 3);
  EXPECT_EQ(third.measured.acc, again.measured.acc);
  EXPECT_EQ(third.measured.gimbal, fresh.measured.gimbal);
  EXPECT_NE(third.measured.acc, simulator.run(timeline, 8, 3).measured.acc);
}

TEST(ProcessNoise, AngleRandomWalkGrowsWithTheSquareRootOfTime) {
  // 200 runs of 1 h: the variance of each axis is q^2 t; 95 % band of a chi-square of 600 degrees.
  const double q = 1e-2 * detail::deg / 60.0;  // [rad/sqrt(s)]
  PlanDefaults defaults;
  defaults.mode = CommandLaw::level;
  TestPlan plan = preset_plan("six", defaults).value();
  plan.positions.resize(1);
  const Timeline timeline = lay_out(plan, harbin);
  TruthSpec truth;
  truth.coupling = Coupling::eq5;
  truth.noise.angle_random_walk = q;
  truth.initial_attitude = 0.0;
  Simulator simulator(truth, Readout{});
  double sum = 0.0;
  for (std::uint64_t run = 0; run < 200; ++run)
    sum += simulator.run(timeline, 1, run).phi.back().squaredNorm();
  EXPECT_NEAR(sum / 600.0 / (q * q * 3600.0), 1.0, 0.115);
}

}  // namespace
}  // namespace drift::dynamics_test
