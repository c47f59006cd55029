#include "core/physics/servo.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <complex>
#include <random>

#include "core/base/dual.hpp"
#include "core/base/units.hpp"
#include "core/ode/cvode.hpp"

namespace drift::servo_test {
namespace {

constexpr int n = ServoState::size;
using State = Eigen::Matrix<double, n, 1>;
using Jacobian = Eigen::Matrix<double, n, n>;
using D = Dual<n>;
const double arcsec = unit::arcsec.to_si, deg_per_h = unit::deg_per_h.to_si;

/// A platform in a constant environment: every input of the loop stands still.
struct Bench {
  ServoOptions servo;
  DriftModel model{Coupling::servo, {}, {}};
  Theta theta = Theta::Zero();
  Vec3 omega_ic_p{6.0e-5, -2.0e-5, 3.5e-5};  ///< about Earth rate [rad/s]
  Vec3 omega_cmd_p{1.0e-5, 4.0e-5, -2.0e-5};

  Bench() {
    model.terms.set(TermLibrary::find_term("fixed_drift").value());
    model.terms.set(TermLibrary::find_term("gyro_misalignment").value());
    theta[TermLibrary::index("D_F_x")] = 0.7 * deg_per_h;
    theta[TermLibrary::index("D_F_y")] = -1.3 * deg_per_h;
    theta[TermLibrary::index("D_F_z")] = 0.4 * deg_per_h;
    theta[TermLibrary::index("eta_x")] = 112.0 * arcsec;
    theta[TermLibrary::index("xi_y")] = -60.0 * arcsec;
    theta[TermLibrary::index("eta_z")] = 80.0 * arcsec;
  }
  template <class S>
  void derivative(const S* x, S* x_dot) const {
    const Inputs<S> in{&model.mounting, Vec3(0, 0, 1).cast<S>(), omega_ic_p.cast<S>(), omega_cmd_p};
    const Eigen::Matrix<S, TermLibrary::num_params, 1> p = theta.cast<S>();
    servo_derivative(servo, model, in, p.data(), x, x_dot);
  }
  State derivative(const State& x) const {
    State x_dot;
    derivative(x.data(), x_dot.data());
    return x_dot;
  }
  Jacobian jacobian(const State& x) const {
    std::array<D, n> variable, x_dot;
    for (int i = 0; i < n; ++i) variable[i] = D::variable(x[i], i);
    derivative(variable.data(), x_dot.data());
    Jacobian J;
    for (int i = 0; i < n; ++i) J.row(i) = x_dot[i].d.head<n>().matrix().transpose();
    return J;
  }
  Eigen::VectorXcd modes(const State& x) const { return MatX(jacobian(x)).eigenvalues(); }
  Inputs<double> inputs() const {
    return {&model.mounting, Vec3(0, 0, 1), omega_ic_p, omega_cmd_p};
  }
  State at_rest() const { return servo_at_rest(servo, model, inputs(), theta.data()); }
  Vec3 rate(Coupling coupling) const {
    DriftModel algebraic = model;
    algebraic.coupling = coupling;
    return platform_rate(algebraic, inputs(), theta.data(), Mat3::Zero());
  }
  /// Rest found from the derivative alone: the single-axis loop is affine in its states.
  State equilibrium() const {
    State x = State::Zero();
    for (int i = 0; i < 3; ++i) x -= MatX(jacobian(x)).fullPivLu().solve(derivative(x));
    return x;
  }
  /// The state after `duration` [s] from x0 by CVODE, stiff method, Dual Jacobian.
  State integrate(const State& x0, double duration, OdeStats* stats = nullptr) const {
    auto f = [this](double, const double* x, double* x_dot) { return derivative(x, x_dot), true; };
    auto J = [this](double, const double* x, double* out) {
      Eigen::Map<Jacobian> result(out);
      result = jacobian(Eigen::Map<const State>(x));
      return true;
    };
    State tolerance;
    tolerance << Vec3::Constant(1e-15), Vec3::Constant(1e-15), Vec3::Constant(1e-15),
        Vec3::Constant(1e-16);
    Cvode ode(Cvode::Method::bdf, {.rel_tol = 1e-10}, {tolerance.data(), n});
    ode.system(f, J);
    ode.start(0.0, x0.data(), duration);
    const OdeResult r = ode.advance(duration);
    EXPECT_TRUE(r.ok()) << r.cause;
    if (stats) *stats = ode.stats();
    return Eigen::Map<const State>(ode.state().data());
  }
};

Vec3 platform(const State& x) {
  return x.segment<3>(ServoState::omega_ip);
}

Mat3 random_coupling(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> number(0.0, 0.1);
  Mat3 m = Mat3::Identity();
  for (int i = 0; i < 9; ++i) m.data()[i] += number(random);
  return m;
}

TEST(Servo, AnIntegratingGyroGivesEquation6ForAnyGainFrictionAndDecoupling) {
  for (unsigned seed = 0; seed < 5; ++seed)
    for (const double gain : {20.0, 200.0, 400.0})
      for (const double friction : {0.0, 1e-3, 1e-1}) {
        Bench b;
        b.servo.loop_gain = gain;
        b.servo.viscous = friction;
        if (seed > 0) b.servo.motor_coupling = random_coupling(seed);
        const Vec3 w = platform(b.equilibrium());
        // Linear solve of a matrix with condition ~1e10: 1e-6 relative at worst.
        EXPECT_LT((w - b.rate(Coupling::eq6)).norm(), 1e-8 * w.norm()) << seed << " " << gain;
        EXPECT_GT((w - b.rate(Coupling::eq5)).norm(), 1e-4 * w.norm());
      }
}

TEST(Servo, ARestrainedGyroLeaksAsTheLoopGainSays) {
  // w_cp = -(beta I + C)^-1 (C w_ic + u), beta = b k_f/(K H): physics.md 1.5.
  Bench b;
  b.servo.float_restraint = 0.1;
  b.servo.loop_gain = 20.0;
  const double beta =
      b.servo.viscous * b.servo.float_restraint / (b.servo.loop_gain * b.servo.wheel_momentum);
  EXPECT_NEAR(1.0 / (1.0 + beta), 0.99975, 1e-6);
  const RateAssembly<double> a = assemble(b.model, b.inputs(), b.theta.data());
  const Mat3 C = Mat3::Identity() + a.E_gp;
  const Vec3 s = C * b.omega_ic_p + a.omega_drift_g + a.omega_torque_g;
  const Vec3 omega_cp = -(C + beta * Mat3::Identity()).inverse() * s;
  const Vec3 w = platform(b.equilibrium());
  EXPECT_LT((w - b.omega_ic_p - omega_cp).norm(), 1e-8 * s.norm());
  EXPECT_GT((w - b.rate(Coupling::eq6)).norm(), 1e-4 * s.norm());
}

TEST(Servo, AConstantTorqueHangsThePlatformOff) {
  Bench b;
  b.servo.viscous = 0.0;
  b.servo.constant_torque = {1e-2, 0.0, -2e-2};
  const State x = b.equilibrium();
  const double to_attitude = b.servo.float_damping / b.servo.wheel_momentum;
  EXPECT_NEAR(to_attitude * x[0] / arcsec, 10.313, 0.001);  // 1e-2/200 rad: physics.md 1.5
  EXPECT_NEAR(to_attitude * x[1] / arcsec, 0.0, 1e-6);
  EXPECT_NEAR(to_attitude * x[2] / arcsec, -20.626, 0.002);
}

TEST(Servo, TheModesAreThoseOfThePlatformInPhysics62) {
  const Bench b;
  const Eigen::VectorXcd modes = b.modes(State::Zero());
  for (const double mode : {-1e4, -332.0, -104.0, -58.0}) {
    int found = 0;
    for (const std::complex<double> e : modes)
      if (std::abs(e - mode) < 0.01 * std::abs(mode)) ++found;
    EXPECT_EQ(found, 3) << mode << "\n" << modes;
  }
}

TEST(Servo, TheLoopIsStableOverTheUsefulGains) {
  for (const double gain : {20.0, 100.0, 200.0, 400.0})
    for (unsigned seed = 0; seed < 4; ++seed) {
      Bench b;
      b.servo.loop_gain = gain;
      b.servo.motor_coupling = seed == 0 ? Mat3(Mat3::Identity()) : random_coupling(seed);
      b.servo.float_dynamics = seed % 2 ? FloatDynamics::coupled : FloatDynamics::single_axis;
      EXPECT_LT(b.modes(b.at_rest()).real().maxCoeff(), -1.0) << gain << " " << seed;
    }
}

TEST(Servo, TheClosedLoopRespondsAsPhysics15Says) {
  // From a torque about one axis to the float, and back through the open loop: T(jw) = L/(1 + L)
  // is the response of -w_cp to w_ic seen by the gyro, here to the gyro drift.
  const Bench b;
  const Jacobian J = b.jacobian(State::Zero());
  State drift = State::Zero();
  drift[ServoState::theta_dot] = b.servo.wheel_momentum / b.servo.float_inertia;
  const auto response = [&](double hertz) {
    const std::complex<double> s(0.0, 2.0 * std::numbers::pi * hertz);
    const Eigen::MatrixXcd A =
        s * Eigen::MatrixXcd::Identity(n, n) - J.cast<std::complex<double>>();
    return -Eigen::VectorXcd(
        A.fullPivLu().solve(drift.cast<std::complex<double>>()))[ServoState::omega_ip];
  };
  EXPECT_LT(std::abs(response(0.1) - 1.0), 2e-4);
  EXPECT_LT(std::abs(response(1.0) - std::complex(1.010, -0.002)), 1e-3);
  EXPECT_LT(std::abs(response(10.0) - std::complex(1.08, -0.56)), 1e-2);
}

TEST(Servo, TheDualJacobianIsThatOfFiniteDifferences) {
  Bench b;
  b.servo.float_dynamics = FloatDynamics::coupled;
  b.servo.coulomb = 1e-3;
  b.servo.float_restraint = 1e-3;
  b.servo.motor_coupling = random_coupling(9);
  State x = b.at_rest();
  x += 1e-5 * State::LinSpaced(n, -1.0, 1.3);
  const Jacobian J = b.jacobian(x);
  for (int k = 0; k < n; ++k) {
    const double h = 1e-8;
    State plus = x, minus = x;
    plus[k] += h;
    minus[k] -= h;
    const State column = (b.derivative(plus) - b.derivative(minus)) / (2.0 * h);
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(J(i, k), column[i], 1e-5 * (1.0 + J.row(i).cwiseAbs().maxCoeff()))
          << i << " " << k;
  }
  EXPECT_GT(std::abs(J(ServoState::theta_dot, ServoState::theta)), 0.0);
}

TEST(Servo, RestIsWhereTheDerivativeVanishes) {
  for (const double restraint : {0.0, 0.1}) {
    Bench b;
    b.servo.float_restraint = restraint;
    b.servo.motor_coupling = random_coupling(4);
    b.servo.constant_torque = {3e-3, -1e-3, 2e-3};
    b.servo.coulomb = restraint > 0.0 ? 0.0 : 2e-3;
    const State x = b.at_rest(), x_dot = b.derivative(x);
    // Residues are differences of terms of these sizes, each rounded to 1e-16.
    EXPECT_LT(x_dot.segment<3>(ServoState::theta_dot).norm(),
              1e-15 * b.servo.wheel_momentum / b.servo.float_inertia);
    EXPECT_LT(x_dot.segment<3>(ServoState::compensator).norm(), 1e-18);
    EXPECT_LT(x_dot.segment<3>(ServoState::omega_ip).norm(), 1e-13);
  }
}

TEST(Servo, CvodeSettlesAtEquation6FromAnywhere) {
  Bench b;
  b.servo.motor_coupling = random_coupling(2);
  b.servo.coulomb = 1e-3;
  b.servo.constant_torque = {1e-2, 0.0, 0.0};
  OdeStats stats;
  const State x = b.integrate(State::Zero(), 100.0, &stats);
  EXPECT_LT((platform(x) - b.rate(Coupling::eq6)).norm(), 1e-12);  // [rad/s], of 1e-4
  EXPECT_LT((x - b.at_rest()).head<9>().norm(), 1e-11);
  EXPECT_LT(stats.steps, 5000);  // the fastest mode alone would force 5e5 explicit steps
  EXPECT_LT(stats.jacobian_calls, stats.steps);
}

TEST(Servo, TheFloatHoldsTheIntegralOfTheRateItFelt) {
  // theta = H/c Integral (C w_ip + u) dt - J_f/c theta_dot: what the loop misses while it settles
  // is an attitude offset, never a drift (physics.md 1.5).
  Bench b;
  b.servo.constant_torque = {0.0, 1e-2, 0.0};
  b.theta.setZero();
  b.omega_ic_p.setZero();
  b.omega_cmd_p.setZero();
  auto f = [&](double, const double* y, double* y_dot) {
    b.derivative(y, y_dot);
    for (int i = 0; i < 3; ++i) y_dot[n + i] = y[ServoState::omega_ip + i];  // attitude
    return true;
  };
  Cvode ode(Cvode::Method::adams, n + 3, {.rel_tol = 1e-9, .abs_tol = 1e-13});
  ode.system(f);
  std::array<double, n + 3> y0{};
  ode.start(0.0, y0.data(), 0.5);
  ASSERT_TRUE(ode.advance(0.5).ok());
  EXPECT_NEAR(ode.state()[n + 1], 1e-2 / 200.0, 1e-9);  // (c/H) T_0/K, H = c
  EXPECT_NEAR(ode.state()[n + 0], 0.0, 1e-15);
}

TEST(Servo, CoupledFloatsFeelOutputAxisAccelerationAndTheirSpinAxis) {
  Bench b;
  b.servo.float_dynamics = FloatDynamics::coupled;
  State x = State::Zero();
  x[ServoState::theta] = 1e-3;                       // x float off null
  x.segment<3>(ServoState::omega_ip) << 0, 0, 1e-2;  // about z, the spin axis of the x gyro
  Bench single = b;
  single.servo.float_dynamics = FloatDynamics::single_axis;
  const State difference = b.derivative(x) - single.derivative(x);
  const Vec3 omega_dot = b.derivative(x).segment<3>(ServoState::omega_ip);
  const double cross = b.servo.wheel_momentum / b.servo.float_inertia * 1e-3 * 1e-2;
  EXPECT_NEAR(difference[ServoState::theta_dot], cross - omega_dot[1], 1e-9 * cross);  // O_x = y
  EXPECT_NEAR(difference[ServoState::theta_dot + 2], -omega_dot[0],
              1e-9 * std::abs(omega_dot[0]));  // O_z = x
  EXPECT_GT(std::abs(omega_dot[0]), 1.0);
}

}  // namespace
}  // namespace drift::servo_test
