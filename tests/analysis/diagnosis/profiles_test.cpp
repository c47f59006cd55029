// Tops and intervals of profiles, against closed forms.
#include "analysis/diagnosis/profiles.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/stats/normal.hpp"

namespace drift::diagnosis::profiles_test {
namespace {

Profile profile_of(const std::vector<double>& values, double (*loss)(double)) {
  Profile p;
  for (const double v : values) p.points.push_back({v, loss(v)});
  return with_interval(p);
}

TEST(Profiles, OfAParabolaAreItsTopAndItsSigma) {
  // Sigma 0.5 about 2.1, counted from -7; no point lies at the top, and they are in no order.
  const Profile p = profile_of({2.0, 0.5, 3.5, 1.25, 2.75},
                               [](double v) { return std::pow((v - 2.1) / 0.5, 2) - 7.0; });
  EXPECT_NEAR(p.top, 2.1, 1e-12);
  EXPECT_NEAR(p.low_95, 2.1 - 0.5 * stats::half_width_95, 1e-12);
  EXPECT_NEAR(p.high_95, 2.1 + 0.5 * stats::half_width_95, 1e-12);
  EXPECT_NEAR(p.points.front().loss, std::pow(1.6 / 0.5, 2), 1e-12);
}

TEST(Profiles, AreWiderWhereTheLossGrowsSlower) {
  // Sigma 1 below the top, 4 above it.
  const Profile p = profile_of({-3.0, -1.5, 0.0, 1.5, 3.0, 9.0},
                               [](double v) { return v < 0.0 ? v * v : v * v / 16.0; });
  EXPECT_NEAR(p.low_95, -stats::half_width_95, 0.2);
  EXPECT_NEAR(p.high_95, 4.0 * stats::half_width_95, 0.6);
}

TEST(Profiles, HaveNoEndBeyondTheirPoints) {
  const Profile p = profile_of({0.0, 1.0, 2.0}, [](double v) { return 9.0 * (2.0 - v); });
  EXPECT_EQ(p.top, 2.0);
  EXPECT_TRUE(std::isnan(p.high_95));
  EXPECT_GT(p.low_95, 1.0);
  EXPECT_LT(p.low_95, 2.0);
}

}  // namespace
}  // namespace drift::diagnosis::profiles_test
