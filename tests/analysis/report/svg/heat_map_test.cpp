#include "analysis/report/svg/heat_map.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/analysis/report/xml_check.hpp"

namespace drift::heat_map_test {
namespace {

using drift::test::xml_problem;

report::HeatMap map_of(Eigen::Index rows, Eigen::Index columns) {
  report::HeatMap map;
  map.title = "t";
  map.value_label = "bit";
  for (Eigen::Index r = 0; r < rows; ++r) map.rows.push_back("row " + std::to_string(r));
  for (Eigen::Index c = 0; c < columns; ++c)
    map.columns.push_back("a long name of column " + std::to_string(c));
  map.value = MatX::Zero(rows, columns);
  return map;
}

TEST(HeatMap, ShowsValuesWithTheLargestDarkest) {
  report::HeatMap map = map_of(2, 2);
  map.value << 4.0, 2.0, 0.0, -1.0;
  const std::string svg = report::svg_of(map);
  EXPECT_EQ(xml_problem(svg), std::nullopt);
  EXPECT_NE(svg.find("#0072B2"), std::string::npos);  // 4 of 4
  EXPECT_NE(svg.find("#80B9D9"), std::string::npos);  // 2 of 4: half way to white
  EXPECT_NE(svg.find("#FFFFFF"), std::string::npos);  // nothing
  EXPECT_NE(svg.find("#F5D7BF"), std::string::npos);  // -1: a quarter of the way to orange
  EXPECT_NE(svg.find(">4</text>"), std::string::npos);
}

TEST(HeatMap, StandsEmptyHugeHostileAndMissingContent) {
  EXPECT_EQ(xml_problem(report::svg_of(map_of(0, 0))), std::nullopt);
  EXPECT_EQ(xml_problem(report::svg_of(map_of(60, 300))), std::nullopt);
  report::HeatMap map = map_of(1, 2);
  map.rows[0] = "<b>&";
  map.columns[1] = "\"x'";
  map.value << std::numeric_limits<double>::quiet_NaN(), 1.0;
  const std::string svg = report::svg_of(map);
  EXPECT_EQ(xml_problem(svg), std::nullopt);
  EXPECT_NE(svg.find("#dddddd"), std::string::npos);  // a missing value is no zero
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace drift::heat_map_test
