// Another latitude where one side of the truth has none.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <utility>

#include "analysis/identification/latitude_doubt.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::polar_latitude_test {
namespace {

TEST(PolarLatitude, IsFoundAtAPoleAndBesideIt) {
  test::SixWithHidden of(std::nullopt, 0.0);
  for (const auto& [truth, declared] : std::initializer_list<std::pair<double, double>>{
           {90.0, 89.0}, {90.0, 45.0}, {89.5, 90.0}, {-90.0, -88.0}, {-88.5, -89.9}}) {
    of.study.site.latitude = truth * unit::deg.to_si;
    const Recording recording = of.recorded(0.0);
    of.study.site.latitude = declared * unit::deg.to_si;
    const auto doubt =
        identification::latitude_doubt(of.study, {recording}, of.study.filters.front());
    ASSERT_TRUE(doubt) << truth << declared;
    // Six positions know it to 0.01 deg or so.
    EXPECT_NEAR(doubt->latitude / unit::deg.to_si, truth, 0.05) << declared;
    EXPECT_LE(std::abs(doubt->latitude), 90.0 * unit::deg.to_si) << declared;
    EXPECT_TRUE(doubt->alone()) << truth << declared << doubt->chance_after;
  }
}

}  // namespace
}  // namespace drift::polar_latitude_test
