#include "analysis/preparation/gravity_check.hpp"

#include <gtest/gtest.h>

#include "core/base/units.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::preparation::gravity_check_test {
namespace {

/// What is said of a platform whose accelerometers read so many g in its dwells, and slew besides.
std::string said(double f, double phase = 0.0) {
  mc::Study study;
  study.filters = {test::base_filter(Coupling::eq5)};
  Recording r;
  r.source = "rec.csv";
  const auto add = [&](const char* name, double value) {
    r.channels.push_back({name, "g"_unit, std::vector<double>(20, value)});
  };
  add("acc_x", 0.6 * f);
  add("acc_y", 0.0);
  add("acc_z", -0.8 * f);
  add("phase", phase);
  for (std::size_t i = 0; i < 20; ++i) r.lines.push_back(i + 2);
  return other_than_one_g(study, r);
}

TEST(GravityCheck, AccelerometersThatDoNotReadGravityAreToldTheUnitThatTheyLookLike) {
  for (const double f : {1.0, 0.97, 1.03}) EXPECT_EQ(said(f), "") << f;
  const std::pair<double, const char*> others[] = {{1e3, "the numbers look like [mg], not [g]"},
                                                   {9.80665, "[m/s^2]"},
                                                   {9.80665 / 0.3048, "[ft/s^2]"},
                                                   {980.665, "[cm/s^2]"},
                                                   {2.5, "no unit known here explains it"},
                                                   {0.5, "no unit known here explains it"}};
  for (const auto& [f, words] : others) {
    EXPECT_NE(said(f).find(words), std::string::npos) << f << ": " << said(f);
    EXPECT_EQ(said(f).find("rec.csv:acc_x: "), 0u) << said(f);
  }
  EXPECT_EQ(said(2.5, 1.0), "") << "nothing is known of slews";
}

}  // namespace
}  // namespace drift::preparation::gravity_check_test
