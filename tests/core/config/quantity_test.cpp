#include "core/config/quantity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/check.hpp"
#include "core/config/load.hpp"

namespace drift::config::quantity_test {
namespace {

Node value(const std::string& toml) {
  return parse_document("v = " + toml, "t").members.front().value;
}

std::optional<Quantity> quantity(const std::string& toml, const Option& option) {
  Report report("t");
  const auto q = read_quantity(report, value(toml), "v", option);
  EXPECT_EQ(q.has_value(), report.errors() == 0) << toml;
  return q;
}

TEST(Quantity, EveryUnitOfTheDimensionIsConverted) {
  const Option angle{"v", unit::arcsec, -36000.0, 36000.0, ""};
  const double arcsec = std::numbers::pi / 180.0 / 3600.0;
  for (const char* text :
       {"\"60 arcsec\"", "\"1 arcmin\"", "'1arcmin'", "\" +60.0  arcsec \"", "\"6e1 arcsec\""})
    EXPECT_NEAR(quantity(text, angle)->si(), 60.0 * arcsec, 1e-18) << text;
  const Option drift{"v", unit::deg_per_h_per_g, -1e3, 1e3, ""};
  EXPECT_NEAR(quantity("\"1.45 deg/h/g\"", drift)->si(), 1.45 * arcsec,
              1e-18);  // 1 deg/h = 1 arcsec/s
  EXPECT_NEAR(quantity("\"1.45 arcsec/s/g\"", drift)->si(), 1.45 * arcsec, 1e-18);
}

TEST(Quantity, DimensionlessNumbersNeedNoUnit) {
  const Option scale{"v", unit::ppm, -1e6, 1e6, ""};
  EXPECT_DOUBLE_EQ(quantity("5e-4", scale)->si(), 5e-4);
  EXPECT_DOUBLE_EQ(quantity("\"500 ppm\"", scale)->si(), 5e-4);
  EXPECT_DOUBLE_EQ(quantity("\"0.05 %\"", scale)->si(), 5e-4);
  EXPECT_DOUBLE_EQ(quantity("1", scale)->si(), 1.0);
}

TEST(Quantity, ARangeHoldsItsEndsInEveryUnit) {
  const Option latitude{"v", unit::deg, -90.0, 90.0, ""};
  EXPECT_TRUE(quantity("\"90 deg\"", latitude));
  EXPECT_TRUE(quantity("\"-5400 arcmin\"", latitude));
  EXPECT_TRUE(quantity("\"0.25 turn\"", latitude));
  EXPECT_FALSE(quantity("\"90.001 deg\"", latitude));
  EXPECT_FALSE(quantity("\"1e999 deg\"", latitude));
  const Option positive{.key = "v", .unit = unit::s, .min = 1.0};
  EXPECT_TRUE(quantity("\"1 h\"", positive));
  EXPECT_FALSE(quantity("\"0.9 s\"", positive));
}

TEST(Quantity, ATemperatureIsGivenOnTheScaleThatIsAskedFor) {
  const Option celsius{.key = "v", .unit = "degC"_unit}, kelvin{.key = "v", .unit = "K"_unit},
      difference{.key = "v", .unit = "degC"_unit, .difference = true};
  EXPECT_DOUBLE_EQ(quantity("\"21 degC\"", celsius)->si(), 21.0);
  EXPECT_DOUBLE_EQ(quantity("\"294.15 K\"", kelvin)->si(), 294.15);
  EXPECT_DOUBLE_EQ(quantity("\"2 K\"", difference)->si(), 2.0);
  EXPECT_FALSE(quantity("\"21 degC\"", kelvin));
  Report report("t");
  EXPECT_FALSE(read_quantity(report, value("\"294.15 K\""), "v", celsius));
  try {
    report.throw_if_wrong();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("Write \"21 degC\" if it is a temperature, \"294.15 "
                                         "degC\" if it is a difference of two"),
              std::string::npos)
        << e.what();
  }
  // The sigma of a distribution is a difference.
  EXPECT_EQ(read_prior(report, value("{ normal = [\"21 degC\", \"2 K\"] }"), "v", celsius),
            normal(21.0, 2.0));
  EXPECT_FALSE(read_prior(report, value("{ uniform = [\"1 degC\", \"2 K\"] }"), "v", celsius));
}

TEST(Quantity, WhatIsNoQuantityIsRefused) {
  const Option time{"v", unit::minute, 0.0, 1e6, ""};
  for (const char* text :
       {"60", "60.0", "\"60\"", "\"\"", "\"min\"", "\"60 mim\"", "\"60 deg\"", "\"1,5 min\"",
        "\"nan min\"", "\"inf min\"", "\"60 min min\"", "\"--5 min\"", "\"0x10 min\"", "true",
        "[\"60 min\"]", "1979-05-27", "{ normal = [\"1 min\", \"1 min\"] }", "inf", "nan"})
    EXPECT_FALSE(quantity(text, time)) << text;
  for (const char* text : {"inf", "-inf", "nan", "\"nan\"", "\"5 deg\"", "\"5 g\""})
    EXPECT_FALSE(quantity(text, Option{"v", unit::one, -1e9, 1e9, ""})) << text;
}

std::optional<Prior> prior(const std::string& toml) {
  Report report("t");
  const auto p =
      read_prior(report, value(toml), "v", Option{"v", unit::arcsec, -3600.0, 3600.0, ""});
  EXPECT_EQ(p.has_value(), report.errors() == 0) << toml;
  return p;
}

TEST(Quantity, DistributionsComeInTheUnitOfTheOption) {
  EXPECT_EQ(prior("{ normal = [\"112 arcsec\", \"20 arcsec\"] }"), normal(112.0, 20.0));
  EXPECT_EQ(prior("{ uniform = [\"-1 arcsec\", \"5 arcsec\"] }"), uniform(-1.0, 5.0));
  EXPECT_EQ(prior("\"7 arcsec\""), fixed(7.0));
  // As check prints them.
  EXPECT_EQ(prior("\"normal(112, 20) arcsec\""), normal(112.0, 20.0));
  EXPECT_EQ(prior("\"uniform(-1.5, 2e1) arcsec\""), uniform(-1.5, 20.0));
  EXPECT_NEAR(prior("{ normal = [\"0 deg\", \"1 arcmin\"] }")->b, 60.0, 1e-12);
}

TEST(Quantity, BrokenDistributionsAreRefused) {
  for (const char* text :
       {"{}", "{ normal = [] }", "{ normal = \"1 arcsec\" }", "{ normal = [\"1 arcsec\"] }",
        "{ normal = [\"1 arcsec\", \"0 arcsec\"] }", "{ normal = [\"1 arcsec\", \"-1 arcsec\"] }",
        "{ uniform = [\"2 arcsec\", \"1 arcsec\"] }", "{ uniform = [\"1 arcsec\", \"1 arcsec\"] }",
        "{ gauss = [\"1 arcsec\", \"1 arcsec\"] }", "{ normal = [\"1 arcsec\", \"1 s\"] }",
        "{ normal = [1, 2] }",
        "{ normal = [\"0 arcsec\", \"1 arcsec\"], uniform = [\"0 arcsec\", \"1 arcsec\"] }"})
    EXPECT_FALSE(prior(text)) << text;
}

TEST(Quantity, PriorsAreShownInTheirUnit) {
  EXPECT_EQ(prior_text(normal(112.0, 20.0), unit::arcsec), "normal(112, 20) arcsec");
  EXPECT_EQ(prior_text(uniform(0.0, 1.0), unit::one), "uniform(0, 1)");
  EXPECT_EQ(prior_text(fixed(0.2), unit::deg_per_h), "0.2 deg/h");
}

}  // namespace
}  // namespace drift::config::quantity_test
