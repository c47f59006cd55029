#include <gtest/gtest.h>

#include "tests/support/case_unit.hpp"

namespace drift::strapdown::gyrocompass_test {

using namespace case_unit;

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

}  // namespace drift::strapdown::gyrocompass_test
