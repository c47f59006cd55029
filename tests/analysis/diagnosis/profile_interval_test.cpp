// Tops and intervals of profiles, against closed forms.
#include "analysis/diagnosis/profile_interval.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/diagnosis/profiles.hpp"
#include "core/stats/normal.hpp"

namespace drift::diagnosis::profile_interval_test {
namespace {

Profile profile_of(const std::vector<double>& values, double (*loss)(double)) {
  Profile p;
  for (const double v : values) p.points.push_back({v, loss(v)});
  return with_interval(p);
}

TEST(ProfileInterval, OfAParabolaAreItsTopAndItsSigma) {
  // Sigma 0.5 about 2.1, counted from -7; no point lies at the top, and they are in no order.
  const Profile p = profile_of({2.0, 0.5, 3.5, 1.25, 2.75},
                               [](double v) { return std::pow((v - 2.1) / 0.5, 2) - 7.0; });
  EXPECT_NEAR(p.top, 2.1, 1e-12);
  EXPECT_NEAR(p.low_95, 2.1 - 0.5 * stats::half_width_95, 1e-12);
  EXPECT_NEAR(p.high_95, 2.1 + 0.5 * stats::half_width_95, 1e-12);
  EXPECT_NEAR(p.points.front().loss, std::pow(1.6 / 0.5, 2), 1e-12);
}

TEST(ProfileInterval, AreWiderWhereTheLossGrowsSlower) {
  // Sigma 1 below the top, 4 above it.
  const Profile p = profile_of({-3.0, -1.5, 0.0, 1.5, 3.0, 9.0},
                               [](double v) { return v < 0.0 ? v * v : v * v / 16.0; });
  EXPECT_NEAR(p.low_95, -stats::half_width_95, 0.2);
  EXPECT_NEAR(p.high_95, 4.0 * stats::half_width_95, 0.6);
}

TEST(ProfileInterval, HaveNoEndBeyondTheirPoints) {
  const Profile p = profile_of({0.0, 1.0, 2.0}, [](double v) { return 9.0 * (2.0 - v); });
  EXPECT_EQ(p.top, 2.0);
  EXPECT_TRUE(std::isnan(p.high_95));
  EXPECT_GT(p.low_95, 1.0);
  EXPECT_LT(p.low_95, 2.0);
}

/// Two valleys: sigma 0.1 about 1, and sigma 0.5 about 4, by `deeper` less deep.
template <int deeper>
double two_valleys(double v) {
  return std::min(std::pow((v - 1.0) / 0.1, 2), deeper + std::pow((v - 4.0) / 0.5, 2));
}
const std::vector<double> about_both{0.7, 0.85, 1.0, 1.15, 1.3, 2.5, 3.25, 4.0, 4.75, 5.5};

TEST(ProfileInterval, OfTwoValleysHoldBothWhereBothAreProbable) {
  // exp(-2) times five times the width: 40 % of all.
  const Profile p = profile_of(about_both, two_valleys<4>);
  EXPECT_NEAR(p.top, 1.0, 1e-12);
  EXPECT_NEAR(p.low_95, 1.0 - 0.1 * stats::half_width_95, 1e-9);
  EXPECT_NEAR(p.high_95, 4.0 + 0.5 * stats::half_width_95, 1e-9);
}

TEST(ProfileInterval, OfTwoValleysHoldOneWhereTheOtherIsNot) {
  // exp(-6) times five: 1.2 % of all.
  const Profile p = profile_of(about_both, two_valleys<12>);
  EXPECT_NEAR(p.low_95, 1.0 - 0.1 * stats::half_width_95, 1e-9);
  EXPECT_NEAR(p.high_95, 1.0 + 0.1 * stats::half_width_95, 1e-9);
}

TEST(ProfileInterval, OfAWideValleyBesideANarrowOneIsFoundByThePointsThatAreAskedFor) {
  // Of the wide valley one point is known; what lies between it and the next is far outside.
  Profile p = profile_of({0.7, 0.85, 1.0, 1.15, 1.3, 4.0, 9.0}, two_valleys<4>);
  for (int round = 0; round < 7; ++round) {
    for (const double v : wanted_points(p, 1.0)) p.points.push_back({v, two_valleys<4>(v)});
    p = with_interval(std::move(p));
  }
  EXPECT_LT(p.points.size(), 30u);
  EXPECT_NEAR(p.low_95, 1.0 - 0.1 * stats::half_width_95, 0.01);
  EXPECT_NEAR(p.high_95, 4.0 + 0.5 * stats::half_width_95, 0.05);
}

/// An onset on a plateau between two walls, as far as it was fitted: the parabola through the least
/// point and its neighbours, one near and one far, has its vertex far below all of them.
double plateau(double v) {
  return v < 0.95 ? 1e3 * std::pow(v - 0.95, 2) + 0.5 : v > 2.0 ? 30.0 * (v - 2.0) : 0.0;
}

TEST(ProfileInterval, HoldsTheBestFitThereIs) {
  std::vector<double> values{0.85, 0.9576, 0.9706, 1.388, 2.5};
  Profile p;
  // What was fitted has noise of its own: the near neighbour lies higher.
  for (const double v : values)
    p.points.push_back({v, v == 0.9576 ? 1.2 : v == 1.388 ? 2.2 : plateau(v)});
  p = with_interval(std::move(p));
  EXPECT_EQ(p.top, 0.9706);
  EXPECT_LT(p.low_95, 0.9706);
  EXPECT_GT(p.high_95, 1.388);
  const std::vector<double> wanted = wanted_points(p, 1.0);
  EXPECT_TRUE(std::ranges::any_of(wanted, [](double v) { return v > 1.0 && v < 1.388; }))
      << "where the top would be";
}

TEST(Profiles, AValueThatItsRefitsDoNotHoldIsTheirTop) {
  const auto size = TermLibrary::find("D_F_x").value();
  const auto stated = [&](double value) {
    search::Cause cause;
    cause.term = "fixed_drift";
    cause.axis = "x";
    cause.parameters = {{"D_F_x", size, value, 0.4, "deg/h"}};
    std::vector<search::Cause> causes{cause};
    Profile profile;
    profile.label = "fixed_drift.x";
    profile.param = size;
    profile.top = 6.15;
    profile.low_95 = 5.4;
    profile.high_95 = 6.9;
    FilterSpec nominal;
    nominal.priors[size] = normal(0.0, 2.0 * TermLibrary::specs[size].unit.to_si);
    set_intervals(causes, {profile}, nominal);
    return causes.front().parameters.front();
  };
  EXPECT_EQ(stated(5.9).value, 5.9);
  EXPECT_EQ(stated(5.9).top, 6.15);
  // Its sigma says another interval: what is told of it is the top, with the sigma of that.
  EXPECT_EQ(stated(5.9).told(), 6.15);
  EXPECT_NEAR(stated(5.9).told_sigma(), 0.75 / stats::half_width_95, 1e-12);
  EXPECT_NEAR(stated(5.9).prior_sigmas, 6.15 / 2.0, 1e-12);
  EXPECT_EQ(stated(0.5).value, 6.15);
  EXPECT_NEAR(stated(0.5).prior_sigmas, 6.15 / 2.0, 1e-12);
  EXPECT_EQ(stated(7.5).value, 6.15);
}

}  // namespace
}  // namespace drift::diagnosis::profile_interval_test
