#include "core/base/units.hpp"

#include <gtest/gtest.h>

namespace drift::units_test {
namespace {

TEST(Units, CompoundUnitsAreProductsOfTheirFactors) {
  EXPECT_DOUBLE_EQ(parse_unit("deg/h")->to_si, std::numbers::pi / 180.0 / 3600.0);
  EXPECT_DOUBLE_EQ(parse_unit("deg/h/g^2")->to_si, parse_unit("deg/h")->to_si);
  EXPECT_DOUBLE_EQ(parse_unit("deg/sqrt(h)")->to_si, std::numbers::pi / 180.0 / 60.0);
  EXPECT_DOUBLE_EQ(parse_unit("ug/g^2")->to_si, 1e-6);
  EXPECT_DOUBLE_EQ(parse_unit("m/s^2")->to_si, 1.0);
  EXPECT_EQ(parse_unit("N*m*s")->dim, parse_unit("kg*m^2/s")->dim);
  EXPECT_EQ(parse_unit("V*A")->dim, parse_unit("N*m/s")->dim);
  EXPECT_EQ(parse_unit("Pa")->dim, parse_unit("N/m^2")->dim);
  EXPECT_DOUBLE_EQ(parse_unit("hPa")->to_si, 100.0);
}

TEST(Units, OneDegreePerHourIsOneArcsecondPerSecond) {
  EXPECT_DOUBLE_EQ(parse_unit("deg/h")->to_si, parse_unit("arcsec/s")->to_si);
  EXPECT_TRUE(parse_unit("deg/h")->same_dimension(*parse_unit("arcsec/s")));
}

TEST(Units, WhatIsNoUnitIsRefused) {
  for (const char* text :
       {"", "furlong", "deg/", "/h", "deg//h", "deg/h/g^", "deg^x", "sqrt(", "deg h"})
    EXPECT_FALSE(parse_unit(text)) << text;
}

TEST(Units, DimensionsAreKeptApart) {
  EXPECT_FALSE(unit::arcsec.same_dimension(unit::one));
  EXPECT_FALSE(unit::g.same_dimension(*parse_unit("m/s^2")));
  EXPECT_FALSE(unit::deg_per_h_per_g.same_dimension(unit::deg_per_h));
  EXPECT_EQ(parse_unit("deg/h/sqrt(h)")->dim.twice[Dimension::time], -3);
}

}  // namespace
}  // namespace drift::units_test
