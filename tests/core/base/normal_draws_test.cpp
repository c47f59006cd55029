#include "core/base/normal_draws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace drift::normal_draws_test {
namespace {

std::vector<double> draws(std::uint64_t seed, std::uint64_t number, std::size_t count) {
  NormalDraws normal(seed, number);
  std::vector<double> z(count);
  for (double& v : z) v = normal();
  return z;
}

TEST(NormalDraws, HaveTheMomentsAndTheTailsOfTheNormalLaw) {
  constexpr std::size_t count = 1'000'000;
  const double n = static_cast<double>(count);
  double sum = 0.0, squares = 0.0, fourth = 0.0, beyond = 0.0;
  for (const double v : draws(7, 3, count)) {
    sum += v;
    squares += v * v;
    fourth += v * v * v * v;
    beyond += std::abs(v) > 3.5 ? 1.0 : 0.0;
  }
  // Five standard errors each: variances 1, 2, 96 and p (1 - p) a draw.
  const double p = std::erfc(3.5 / std::sqrt(2.0));
  EXPECT_NEAR(sum / n, 0.0, 5.0 * std::sqrt(1.0 / n));
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3.0, 5.0 * std::sqrt(96.0 / n));
  EXPECT_NEAR(beyond / n, p, 5.0 * std::sqrt(p / n));
}

TEST(NormalDraws, AreAFunctionOfSeedAndNumberAndEachStreamIsItsOwn) {
  const auto a = draws(7, 3, 10'000);
  EXPECT_EQ(a, draws(7, 3, 10'000));
  for (const auto& b : {draws(7, 4, 10'000), draws(8, 3, 10'000)}) {
    double product = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) product += a[k] * b[k];
    EXPECT_LT(std::abs(product), 5.0 * std::sqrt(10'000.0));
  }
}

}  // namespace
}  // namespace drift::normal_draws_test
