// Values of a sweep as labels and as numbers of an axis.
#include "analysis/report/page/swept_value.hpp"

#include <gtest/gtest.h>

#include <set>

namespace drift::swept_value_test {
namespace {

using report::short_value;
using report::swept_number;

TEST(SweptValue, OfATableIsShortAsALabel) {
  EXPECT_EQ(short_value("{ eta = { normal = [\"0 arcsec\", \"5 arcsec\"] }, xi = { normal = [\"0 "
                        "arcsec\", \"7 arcsec\"] } }"),
            "eta 0 +- 5 arcsec, xi 0 +- 7 arcsec");
  EXPECT_EQ(report::last_member("{ accelerometer_noise = \"1 ug\", gimbal_noise = \"2 arcsec\" }"),
            "gimbal_noise");
  EXPECT_EQ(short_value("20 arcsec"), "20 arcsec");
  EXPECT_EQ(short_value("{ preset = \"six\" }"), "six");
  EXPECT_EQ(short_value("{ preset = \"six\", dwell = \"20 min\" }"), "preset six, dwell 20 min");
  EXPECT_EQ(short_value("{ eta = \"5 arcsec\" }"), "eta 5 arcsec");
  EXPECT_EQ(short_value("{ gimbals = true, starts = 3 }"), "gimbals true, starts 3");
  EXPECT_EQ(short_value("{ servo = { lead = \"1 s\", lag = \"2 s\" } }"),
            "servo (lead 1 s, lag 2 s)");
  EXPECT_EQ(report::last_member("20 arcsec"), "");
}

/// All of these were "D_F 5 deg/h".
TEST(SweptValue, OtherValuesHaveOtherLabels) {
  const std::string values[] = {R"({ D_F = "5 deg/h" })",
                                R"({ D_F = { normal = ["0 deg/h", "5 deg/h"] } })",
                                R"({ D_F = { normal = ["-40 deg/h", "5 deg/h"] } })",
                                R"({ D_F = { uniform = ["-90 deg/h", "5 deg/h"] } })",
                                R"({ D_F = { uniform = ["-90 arcmin/h", "5 deg/h"] } })"};
  const std::set<std::string> labels{"D_F 5 deg/h", "D_F 0 +- 5 deg/h", "D_F -40 +- 5 deg/h",
                                     "D_F -90 to 5 deg/h", "D_F -90 arcmin/h to 5 deg/h"};
  std::set<std::string> found;
  for (const std::string& value : values) found.insert(short_value(value));
  EXPECT_EQ(found, labels);
  EXPECT_EQ(short_value(R"({ normal = [0.1, 0.2] })"), "0.1 +- 0.2");
}

TEST(SweptNumber, IsFoundInQuantitiesAndDistributions) {
  EXPECT_DOUBLE_EQ(swept_number("20 arcsec")->si, 20.0 * "arcsec"_unit.to_si);
  EXPECT_EQ(swept_number("20 arcsec")->unit.symbol.view(), "arcsec");
  EXPECT_DOUBLE_EQ(swept_number("0.5")->si, 0.5);
  EXPECT_DOUBLE_EQ(swept_number("{ normal = [\"0 arcsec\", \"35 arcsec\"] }")->si,
                   35.0 * "arcsec"_unit.to_si);
  EXPECT_DOUBLE_EQ(swept_number("-1.5e-2 deg/h/g^2")->si, -1.5e-2 * "deg/h/g^2"_unit.to_si);
  EXPECT_FALSE(swept_number("eq5"));
  EXPECT_FALSE(swept_number("slew12"));
  EXPECT_FALSE(swept_number("free"));
}

TEST(SweptNumber, IsOfOneKindWhereOnlyTheNumberDiffers) {
  const auto alike = [](const std::string& a, const std::string& b) {
    return swept_number(a)->kind == swept_number(b)->kind;
  };
  const std::string about_zero = R"({ normal = ["0 deg/h", "5 deg/h"] })";
  EXPECT_TRUE(alike("5 deg/h", "7 arcmin/h"));
  EXPECT_FALSE(alike("5 deg/h", about_zero));
  EXPECT_TRUE(alike(about_zero, R"({ normal = ["0 deg/h", "7 deg/h"] })"));
  EXPECT_FALSE(alike(about_zero, R"({ normal = ["1 deg/h", "5 deg/h"] })"));
  EXPECT_TRUE(alike(R"({ uniform = ["-5 ug", "5 ug"] })", R"({ uniform = ["-7 ug", "7 ug"] })"));
  EXPECT_FALSE(alike(R"({ uniform = ["-5 ug", "5 ug"] })", R"({ uniform = ["-5 ug", "7 ug"] })"));
  EXPECT_TRUE(alike(R"({ eta = "1 arcsec", xi = "2 arcsec" })",
                    R"({ eta = "5 arcsec", xi = "9 arcsec" })"));
  EXPECT_FALSE(alike(R"({ eta = "1 arcsec" })", R"({ xi = "1 arcsec" })"));
  EXPECT_FALSE(alike("[1, 5]", "[2, 5]"));
}

}  // namespace
}  // namespace drift::swept_value_test
