#include "analysis/preparation/gravity_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

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

/// What is said of a platform with two slanted positions and three upright ones, of which some
/// accelerometers read so many times too much.
std::string said_of_axes(const Vec3& factors, const char* unit = "g") {
  mc::Study study;
  study.filters = {test::base_filter(Coupling::eq5)};
  const Vec3 up[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), {0.6, 0.8, 0.0}, {0.0, 0.6, 0.8}};
  Recording r;
  r.source = "rec.csv";
  Channel acc[3] = {{"acc_x", *parse_unit(unit), {}},
                    {"acc_y", *parse_unit(unit), {}},
                    {"acc_z", *parse_unit(unit), {}}};
  Channel position{"position", "1"_unit, {}};
  for (int p = 0; p < 5; ++p)
    for (int row = 0; row < 7; ++row) {
      // A knock in two rows of each is not the rest.
      const double knock = row < 2 ? 3.0 : 1.0;
      for (int i = 0; i < 3; ++i) acc[i].values.push_back(knock * factors[i] * up[p][i]);
      position.values.push_back(p + 1);
      r.lines.push_back(r.lines.size() + 2);
    }
  r.channels = {position, acc[0], acc[1], acc[2]};
  return other_than_one_g(study, r);
}

TEST(GravityCheck, OneOrTwoAccelerometersInAnotherUnitAreNamed) {
  EXPECT_EQ(said_of_axes({1.0, 1.0, 1.0}), "");
  EXPECT_EQ(said_of_axes({1.0, 1.03, 0.98}), "") << "within the room of bias and scale";
  struct Case {
    Vec3 factors;
    const char *columns, *words, *unit = "g";
  };
  constexpr double g = 9.80665;
  const Case cases[] = {
      {{1.0, g, 1.0},
       "rec.csv:acc_y: ",
       "Correct its unit: the numbers look like [m/s^2], not [g]"},
      {{1.0, 1.0, 1e3}, "rec.csv:acc_z: ", "look like [mg], not [g]"},
      {{1e-3, 1.0, 1.0}, "rec.csv:acc_x: ", "look like [g], not [mg]", "mg"},
      {{g, 1.0, g}, "rec.csv:acc_x, acc_z: ", "Correct their unit: the numbers look like [m/s^2]"},
      {{1.0, 1.0, 1.3}, "rec.csv:acc_z: ", "no unit known here explains it"},
      {{g, g, g}, "rec.csv:acc_x: ", "the accelerometers together read 9.807 g, as half"}};
  for (const Case& c : cases) {
    const std::string text = said_of_axes(c.factors, c.unit);
    EXPECT_EQ(text.find(c.columns), 0u) << text;
    EXPECT_NE(text.find(c.words), std::string::npos) << text;
  }
}

TEST(GravityCheck, PositionsInAnotherUnitAreNamed) {
  mc::Study study;
  study.filters = {test::base_filter(Coupling::eq5)};
  const auto said = [&](double f, std::initializer_list<int> where) {
    Recording r;
    r.source = "rec.csv";
    Unit unit = "m/s^2"_unit;
    unit.to_si = 1.0 / 9.80665;  // as it is read
    Channel acc[3] = {{"acc_x", unit, {}}, {"acc_y", unit, {}}, {"acc_z", unit, {}}};
    Channel position{"position", "1"_unit, {}};
    for (int p = 1; p <= 6; ++p)
      for (int row = 0; row < 7; ++row) {
        const bool there = std::ranges::find(where, p) != where.end();
        for (int i = 0; i < 3; ++i) acc[i].values.push_back(i == p % 3 ? (there ? f : 1.0) : 0.0);
        position.values.push_back(p);
        r.lines.push_back(r.lines.size() + 2);
      }
    r.channels = {position, acc[0], acc[1], acc[2]};
    return other_than_one_g(study, r);
  };
  EXPECT_EQ(said(1.04, {5}), "") << "within the room of bias and scale";
  const std::string g = said(1.0 / 9.80665, {5});
  EXPECT_NE(g.find("in position 5 the accelerometers together read 0.102 g"), std::string::npos)
      << g;
  EXPECT_NE(g.find("in the other 5 1 g"), std::string::npos) << g;
  EXPECT_NE(g.find("There the numbers look like [g], not [m/s^2]"), std::string::npos) << g;
  const std::string none = said(0.4, {1, 5});
  EXPECT_NE(none.find("in positions 1 and 5"), std::string::npos) << none;
  EXPECT_NE(none.find("leave the position out of the file"), std::string::npos) << none;
}

}  // namespace
}  // namespace drift::preparation::gravity_check_test
