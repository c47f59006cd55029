#include "mc/study/design.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/stats/normal.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::design_test {
namespace {

using namespace drift::test;

TEST(Permutation, HitsEveryNumberOnceAndDependsOnItsKey) {
  for (const std::uint64_t n : {1u, 2u, 3u, 7u, 16u, 17u, 1000u}) {
    std::set<std::uint64_t> seen;
    for (std::uint64_t k = 0; k < n; ++k) {
      const auto image = mc::permuted(k, n, 3, 9);
      EXPECT_LT(image, n);
      seen.insert(image);
    }
    EXPECT_EQ(seen.size(), n);
  }
  int equal = 0;
  for (std::uint64_t k = 0; k < 1000; ++k)
    equal += mc::permuted(k, 1000, 3, 9) == mc::permuted(k, 1000, 3, 10);
  EXPECT_LT(equal, 10);  // Poisson of mean 1
}

TruthSpec two_normal_parameters() {
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active = only({"D_F_x", "eta_y", "s_z"});
  truth.priors[param("D_F_x")] = normal(1.0, 2.0);
  truth.priors[param("eta_y")] = uniform(-3.0, 5.0);
  truth.priors[param("s_z")] = fixed(0.25);
  return truth;
}

TEST(LatinHypercube, HasOneRunInEachStratumOfEachParameter) {
  constexpr std::uint64_t n = 500;
  const TruthSpec truth = two_normal_parameters();
  mc::Design design(truth, mc::DesignKind::latin_hypercube, n, 17);
  for (const std::uint64_t first : {std::uint64_t{0}, n}) {  // later runs are a further hypercube
    std::vector<double> u, v;
    for (std::uint64_t run = first; run < first + n; ++run) {
      const Theta theta = design.draw(run, 1).theta;
      u.push_back(stats::normal_distribution((theta[param("D_F_x")] - 1.0) / 2.0));
      v.push_back((theta[param("eta_y")] + 3.0) / 8.0);
      EXPECT_EQ(theta[param("s_z")], 0.25);
    }
    // Two permutations that have nothing to do with each other: correlation within 4 / sqrt(n).
    double correlation = 0.0;
    for (std::size_t k = 0; k < n; ++k) correlation += 12.0 * (u[k] - 0.5) * (v[k] - 0.5) / n;
    EXPECT_LT(std::abs(correlation), 4.0 / std::sqrt(n));
    std::ranges::sort(u);
    std::ranges::sort(v);
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_EQ(std::floor(u[k] * n), k);
      EXPECT_EQ(std::floor(v[k] * n), k);
    }
  }
  EXPECT_NE(design.draw(3, 1).theta, design.draw(3 + n, 1).theta);
}

/// Warnock's formula for the L2 star discrepancy in two dimensions.
double discrepancy(const std::vector<std::pair<double, double>>& points) {
  const double n = static_cast<double>(points.size());
  double single = 0.0, both = 0.0;
  for (const auto& [x, y] : points) {
    single += (1.0 - x * x) * (1.0 - y * y);
    for (const auto& [a, b] : points) both += (1.0 - std::max(x, a)) * (1.0 - std::max(y, b));
  }
  return std::sqrt(1.0 / 9.0 - 2.0 * single / (4.0 * n) + both / (n * n));
}

TEST(Sobol, FillsThePlaneMoreEvenlyThanChance) {
  const TruthSpec truth = two_normal_parameters();
  double found[2];
  for (const auto kind : {mc::DesignKind::random, mc::DesignKind::sobol}) {
    mc::Design design(truth, kind, 512, 17);
    std::vector<std::pair<double, double>> points;
    for (std::uint64_t run = 0; run < 512; ++run) {
      const Theta theta = design.draw(run, 1).theta;
      points.emplace_back(stats::normal_distribution((theta[param("D_F_x")] - 1.0) / 2.0),
                          (theta[param("eta_y")] + 3.0) / 8.0);
    }
    found[kind == mc::DesignKind::sobol] = discrepancy(points);
    if (kind == mc::DesignKind::random) continue;
    // A digitally shifted (0, 2)-sequence: each of 512 equal intervals, of either axis, holds one
    // point.
    for (const bool second : {false, true}) {
      std::set<int> intervals;
      for (const auto& [x, y] : points)
        intervals.insert(static_cast<int>(512.0 * (second ? y : x)));
      EXPECT_EQ(intervals.size(), 512u);
    }
  }
  // Chance: sqrt((1/4 - 1/9) / n) = 0.0165. The sequence is of order log(n) / n = 0.012 / 5.
  EXPECT_LT(found[1], 0.25 * found[0]);
}

TEST(Design, IsAPureFunctionOfTheRun) {
  const TruthSpec truth = base_truth(Coupling::eq5);
  for (const auto kind :
       {mc::DesignKind::random, mc::DesignKind::latin_hypercube, mc::DesignKind::sobol}) {
    mc::Design one(truth, kind, 100, 3), other(truth, kind, 100, 3);
    const TruthDraw alone = one.draw(42, 6);
    for (const std::uint64_t run : {7, 99, 0, 41}) other.draw(run, 6);
    const TruthDraw after = other.draw(42, 6);
    EXPECT_EQ(alone.theta, after.theta);
    EXPECT_EQ(alone.psi0_l, after.psi0_l);
    EXPECT_NE(alone.theta, one.draw(43, 6).theta);
  }
}

TEST(Design, HasTheMomentsOfThePrior) {
  // Of 4096 stratified values the mean is off by less than 0.01 sigma, the variance by 2 %.
  const TruthSpec truth = base_truth(Coupling::eq5);
  for (const auto kind : {mc::DesignKind::latin_hypercube, mc::DesignKind::sobol}) {
    mc::Design design(truth, kind, 4096, 1);
    double mean = 0.0, square = 0.0;
    const auto p = param("K_ip_z");
    for (std::uint64_t run = 0; run < 4096; ++run) {
      const double z = design.draw(run, 1).theta[p] / truth.priors[p].b;
      mean += z / 4096;
      square += z * z / 4096;
    }
    EXPECT_NEAR(mean, 0.0, 0.01);
    EXPECT_NEAR(square, 1.0, 0.02);
  }
}

}  // namespace
}  // namespace drift::design_test
