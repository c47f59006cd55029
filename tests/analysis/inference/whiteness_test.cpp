#include "analysis/inference/whiteness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.hpp"
#include "tests/support/white_problem.hpp"

namespace drift::inference::whiteness_test {
namespace {

constexpr int channels = 3, chains = 4, samples = 12;  // short dwells
constexpr Eigen::Index rows = channels * chains * samples;
constexpr Eigen::Index parameters = 20;

/// A test of many parameters and short dwells; innovations with correlation `phi` from one to the
/// next.
LinearProblem scene(double phi, std::uint64_t seed) {
  LinearProblem s = test::white_problem(MatX(rows, parameters), MatX(rows, 0), VecX::Zero(rows));
  s.tags.clear();
  s.drives.clear();
  for (int chain = 0; chain < chains; ++chain)
    for (int t = 0; t < samples; ++t) {
      IntervalDrive drive;
      drive.chain = chain;
      for (int c = 0; c < channels; ++c) s.tags.push_back({s.drives.size(), c, chain});
      s.drives.push_back(drive);
    }
  Stream columns(1, 0, Purpose::test), noise(seed, 1, Purpose::test);
  for (Eigen::Index k = 0; k < rows; ++k)
    for (Eigen::Index j = 0; j < parameters; ++j) s.theta(k, j) = columns.normal();
  for (Eigen::Index k = 0; k < rows; ++k) {
    const bool first = k % (channels * samples) < channels;
    const double z = noise.normal();
    s.r0[k] = first ? z : phi * s.r0[k - channels] + std::sqrt(1.0 - phi * phi) * z;
  }
  VecX x(parameters);
  for (double& v : x) v = noise.normal();
  s.r0 += s.theta * x;
  return s;
}

double p_of(const LinearProblem& s, int draws = 99) {
  return whiteness_p(s, Projector(s, {}), 5, draws, 7);
}

TEST(Whiteness, PValuesOfWhiteInnovationsAreUniformThoughDwellsAreShortAndParametersMany) {
  constexpr int trials = 200;
  int below_tenth = 0, below_half = 0;
  for (int k = 0; k < trials; ++k) {
    const double p = p_of(scene(0.0, static_cast<std::uint64_t>(100 + k)));
    below_tenth += p <= 0.1;
    below_half += p <= 0.5;
  }
  // Binomial: 20 +- 4.2 and 100 +- 7.1; four standard deviations.
  EXPECT_NEAR(below_tenth, 20, 17);
  EXPECT_NEAR(below_half, 100, 29);
}

TEST(Whiteness, CorrelatedInnovationsAreFound) {
  // Per channel 44 pairs at lag 1 with r = 0.7: Q gains some 20, several times its mean of 5.
  int found = 0;
  for (int k = 0; k < 10; ++k)
    found += p_of(scene(0.7, static_cast<std::uint64_t>(500 + k))) <= 0.02;
  EXPECT_GE(found, 9);
}

TEST(Whiteness, IsRepeatableAndNeverZero) {
  const LinearProblem s = scene(0.9, 3);
  EXPECT_EQ(p_of(s), p_of(s));
  EXPECT_EQ(p_of(s), 1.0 / 100.0);
  EXPECT_EQ(p_of(s, 0), 1.0);
}

}  // namespace
}  // namespace drift::inference::whiteness_test
