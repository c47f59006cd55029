#include "analysis/strapdown/rate_about_up.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace drift::strapdown {
namespace {

const std::vector<Vec3> cardinal = {Vec3::UnitX(),  Vec3::UnitY(),  Vec3::UnitZ(),
                                    -Vec3::UnitX(), -Vec3::UnitY(), -Vec3::UnitZ()};
const Vec3 drift{3e-5, -2e-5, 1e-5};

std::vector<Vec3> read_at(const std::vector<Vec3>& up, double rate) {
  std::vector<Vec3> all;
  for (const Vec3& u : up) all.push_back(drift + rate * u);
  return all;
}

TEST(RateAboutUp, IsToldFromDrifts) {
  constexpr double rate = 5.2e-5;
  const auto found = rate_about_up(cardinal, read_at(cardinal, rate));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->rate, rate, 1e-15);
  EXPECT_LT(found->sigma, 1e-15);
}

// With the drift of every axis free, six cardinal rests leave the mean of the six: one of them off
// by e moves the rate by e/6. Left are e/3 on the two rests of that axis and -e/6 on the other
// four, with two degrees of freedom.
TEST(RateAboutUp, HasTheSigmaOfTheScatter) {
  constexpr double rate = 5.2e-5, e = 6e-7;
  auto read = read_at(cardinal, rate);
  read[0] += e * cardinal[0];
  const auto found = rate_about_up(cardinal, read);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->rate - rate, e / 6.0, 1e-15);
  const double squares = e * e * (2.0 / 9.0 + 4.0 / 36.0);
  EXPECT_NEAR(found->sigma, std::sqrt(squares / 2.0 / 6.0), 1e-15);
}

TEST(RateAboutUp, IsNotToldWhereTheAttitudesDoNotTellItFromDrift) {
  const std::vector<Vec3> same(6, Vec3::UnitZ());
  EXPECT_FALSE(rate_about_up(same, read_at(same, 5.2e-5)));
  // Turned about an axis of the case that leans: the drift along it is read in all rests alike.
  std::vector<Vec3> leaning;
  for (int k = 0; k < 8; ++k) {
    const double turn = 0.7853981633974483 * k;
    leaning.push_back(Vec3(0.6 * std::cos(turn), 0.6 * std::sin(turn), 0.8));
  }
  EXPECT_FALSE(rate_about_up(leaning, read_at(leaning, 5.2e-5)));
  std::vector<Vec3> exact;
  for (const auto& [x, y] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}})
    exact.insert(exact.end(), 2, Vec3(0.6 * x, 0.6 * y, 0.8));
  EXPECT_FALSE(rate_about_up(exact, read_at(exact, 5.2e-5))) << "singular to the last bit";
  const std::vector<Vec3> four(cardinal.begin(), cardinal.begin() + 4);
  EXPECT_FALSE(rate_about_up(four, read_at(four, 5.2e-5))) << "no residual";
}

}  // namespace
}  // namespace drift::strapdown
