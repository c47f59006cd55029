// Coulomb friction of a servo: what it does to filters, by how the platform comes to a position.
#include <gtest/gtest.h>

#include "mc/statistics/point_statistics.hpp"
#include "mc/task/left_out.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::servo_friction_test {
namespace {

using Keys = std::vector<std::string_view>;

/// Four positions, a servo and a filter on the equation that it settles to.
mc::Study study(const std::string& entry, const std::string& coulomb) {
  std::string text = R"toml(schema = 1
title = "Friction"
[site]
latitude = "45.75 deg"
[plan]
dwell = "20 min"
sample = "5 min"
[[plan.position]]
axes = "x=N y=W z=U"
[[plan.position]]
axes = "x=N y=U z=E"
entry = "ENTRY"
[[plan.position]]
axes = "x=U y=S z=E"
entry = "ENTRY"
[[plan.position]]
axes = "x=W y=S z=U"
entry = "ENTRY"
[readout]
accelerometer_noise = "20 ug"
gimbal_noise = "2 arcsec"
[truth]
coupling = "servo"
terms = ["fixed_drift", "gyro_misalignment"]
[truth.servo]
coulomb = "COULOMB N*m"
[[filter]]
name = "settled"
coupling = "eq6"
terms = ["fixed_drift", "gyro_misalignment"]
[monte_carlo]
runs = 40
seed = 5
estimator = "iterated"
)toml";
  const std::pair<std::string, std::string> given[] = {{"ENTRY", entry}, {"COULOMB", coulomb}};
  for (const auto& [name, value] : given)
    for (std::size_t at; (at = text.find(name)) != std::string::npos;)
      text.replace(at, name.size(), value);
  return test::read_text(text);
}

/// By how many sigmas of chance NEES/dof of 40 runs is above 1.
double nees_above(const mc::Study& s) {
  const mc::StudyTask task(s);
  const auto worker = task.worker();
  mc::PointStatistics statistics(task.study());
  statistics.add(test::run_block(task, *worker, 0, 40));
  EXPECT_EQ(statistics.failures().lost().hits, 0u);
  return statistics.filters()[0].starts()[0].nees.sigmas_above();
}

/// The hang-off of 0.01 N*m is 10.3 arcsec (physics.md 1.5), five sigmas of a reading: seen through
/// slews, and part of the attitude after a caging. 5 sigma of chance are nobody's mistake.
TEST(ServoFriction, IsLeftOutWhereThePlatformIsSlewed) {
  const mc::Study slewed = study("torqued", "0.01"), caged = study("caged", "0.01"),
                  smooth = study("torqued", "0");
  EXPECT_EQ(mc::left_out(slewed, 0).noise, (Keys{"servo.coulomb"}));
  EXPECT_TRUE(mc::left_out(caged, 0).nothing());
  EXPECT_TRUE(mc::left_out(smooth, 0).nothing());
  EXPECT_GT(nees_above(slewed), 5.0);
  EXPECT_LT(std::abs(nees_above(caged)), 5.0);
  EXPECT_LT(std::abs(nees_above(smooth)), 5.0);
}

TEST(ServoFriction, IsThatOfAServoAlone) {
  mc::Study other = study("torqued", "0.01");
  other.truth.coupling = Coupling::eq6;
  EXPECT_TRUE(mc::left_out(other, 0).nothing());
}

}  // namespace
}  // namespace drift::servo_friction_test
