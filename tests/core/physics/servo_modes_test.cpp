#include "core/physics/servo_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::servo_modes_test {
namespace {

constexpr double misaligned = 8.4e-4;  // [rad] 100 arcsec of each angle, were they all one turn

TEST(ServoModes, TheDefaultLoopSettlesAsItsOptionsSay) {
  const ServoModes modes = servo_modes({});
  EXPECT_FALSE(modes.grows());
  EXPECT_NEAR(modes.slowest.real(), -57.82, 0.01);  // physics.md 6.2: -58 1/s
  EXPECT_NEAR(modes.slowest.imag(), 0.0, 1e-3);
  EXPECT_NEAR(modes.time(), 1.0 / 57.82, 1e-5);
  EXPECT_FALSE(servo_modes({}, misaligned).grows());
}

TEST(ServoModes, ALeadThatOnlyMakesUpForTheLagsLetsMisalignedGyrosGrow) {
  // T1 - T2 = J_f/c: nothing damps but friction, b/(2 J_p) = 0.01 1/s at most.
  ServoOptions servo;
  servo.lead = 0.0021;
  const ServoModes alone = servo_modes(servo), turned = servo_modes(servo, misaligned);
  EXPECT_FALSE(alone.grows());
  EXPECT_GT(alone.slowest.real(), -0.01);
  EXPECT_TRUE(turned.grows());
  // lambda^2 = -mu K H/(c J_p), so a turn of the gain by i t moves lambda by half of |lambda| t.
  const double moved = 0.5 * std::abs(alone.slowest) * misaligned;
  EXPECT_NEAR(turned.slowest.real() - alone.slowest.real(), moved, 0.01 * moved);
  servo.lead = 0.0;
  EXPECT_TRUE(servo_modes(servo).grows());
  servo = {};
  servo.loop_gain = 1e9;
  EXPECT_TRUE(servo_modes(servo).grows());
}

TEST(ServoModes, AreThoseOfTheGainsThatTheMotorsAreCoupledBy) {
  const ServoModes identity = servo_modes({}, misaligned);
  ServoOptions servo;
  servo.motor_coupling << 1.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0;  // eigenvalues 1
  EXPECT_NEAR(std::abs(servo_modes(servo, misaligned).slowest - identity.slowest), 0.0, 1e-6);
  // A turn of the motors is one of the gyros.
  servo.motor_coupling << 1.0, misaligned, 0.0, -misaligned, 1.0, 0.0, 0.0, 0.0, 1.0;
  EXPECT_NEAR(std::abs(servo_modes(servo).slowest - identity.slowest), 0.0, 1e-6);
  servo.motor_coupling = -Mat3::Identity();  // the wrong sign
  EXPECT_TRUE(servo_modes(servo).grows());
  servo.motor_coupling << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;  // another axis' motor
  EXPECT_TRUE(servo_modes(servo).grows());
}

TEST(ServoModes, NeitherFrictionThatHoldsNorARestraintIsAnInstability) {
  ServoOptions servo;
  servo.coulomb = 1e-2;
  EXPECT_EQ(servo_modes(servo).slowest, servo_modes({}).slowest);
  servo = {};
  servo.float_restraint = 0.1;
  servo.loop_gain = 20.0;
  EXPECT_FALSE(servo_modes(servo, misaligned).grows());
  servo = {};
  servo.viscous = 0.0;
  EXPECT_FALSE(servo_modes(servo, misaligned).grows());
  // An open loop: the float integrates what it feels, which is a mode at zero.
  servo.motor_coupling = Mat3::Zero();
  EXPECT_FALSE(servo_modes(servo).grows());
  EXPECT_TRUE(std::isinf(servo_modes(servo).time()));
}

}  // namespace
}  // namespace drift::servo_modes_test
