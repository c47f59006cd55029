// Each limit met from both sides, by numbers that are written out here: who moves a limit meets its
// test.
#include "analysis/inference/thresholds.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "analysis/inference/max_t.hpp"
#include "analysis/inference/noise/gross_misfit.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/noise/robust_weights.hpp"

namespace drift::inference::thresholds_test {
namespace {

TEST(Thresholds, TracesAreTheSameWhereSixtyThreeSigmaWouldNotTellThemByTwo) {
  EXPECT_NEAR(2.0 / std::sqrt(TraceLimits::unlike), 63.25, 0.01);
  const double limit = std::sqrt(1.0 - 1e-3);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(same_trace(sign * (limit + 1e-6)));
    EXPECT_FALSE(same_trace(sign * (limit - 1e-6)));
  }
  EXPECT_TRUE(same_trace_of_unlike(0.99e-3));
  EXPECT_FALSE(same_trace_of_unlike(1.01e-3));
}

TEST(Thresholds, TheChanceOfAFalseAlarmIsSharedWhole) {
  EXPECT_DOUBLE_EQ(SearchLimits::library_share + SearchLimits::scan_share +
                       SearchLimits::pair_share + SearchLimits::lone_share +
                       SearchLimits::periodic_share,
                   1.0);
}

TEST(Thresholds, AColumnIsSeenWhereFortyPriorSigmasAreFoundByFour) {
  const auto dof = [](double information) {
    return make_contrast(MatX::Constant(1, 1, information), VecX::Ones(1), {0}).dof;
  };
  EXPECT_EQ(dof(1.01e-2), 1);
  EXPECT_EQ(dof(0.99e-2), 0);
}

/// Rows of one accelerometer, residuals given by their number.
template <class Residual>
std::pair<MeasuredRows, VecX> rows_of(Eigen::Index n, Residual&& residual) {
  MeasuredRows rows;
  VecX r(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    rows.tags.push_back({static_cast<std::size_t>(k), 0, 0});
    r[k] = residual(k);
  }
  rows.weight = VecX::Ones(n);
  return {std::move(rows), std::move(r)};
}

TEST(Thresholds, AMisfitOfThirtyTimesTheNoiseIsAskedForUsualNoise) {
  NoiseEstimate differences;
  differences.model.acc_factor = 2.0;
  const auto wrong = [&](double chi2_per_row) {
    const auto [rows, residual] =
        rows_of(100, [&](Eigen::Index) { return 2.0 * std::sqrt(chi2_per_row); });
    return grossly_wrong(rows, residual, differences);
  };
  EXPECT_FALSE(wrong(29.9));
  EXPECT_TRUE(wrong(30.1));
}

TEST(Thresholds, DrivingNoiseIsUsualWhereOneInstrumentInFortyHasMore) {
  const auto usual = [](double deg_per_h_per_sqrt_h) {
    NoiseEstimate noise;
    noise.components = {&acc_white, &drift_walk};
    noise.model.drift_random_walk = deg_per_h_per_sqrt_h * drift_walk.unit.to_si;
    return driven_as_usual({}, noise, {});
  };
  // One sigma of the logarithm to either side of sqrt(1e-3 * 5e-3), Student's t of three degrees.
  const double t = boost::math::quantile(boost::math::students_t(3.0), 1.0 - 1.0 / 40.0);
  const double limit = std::sqrt(1e-3 * 5e-3) * std::pow(5.0, 0.5 * t);
  EXPECT_TRUE(usual(0.999 * limit));
  EXPECT_FALSE(usual(1.001 * limit));
  NoiseEstimate white;
  white.components = {&acc_white, &gimbal_white};
  EXPECT_FALSE(driven_as_usual({}, white, {}));
}

/// Rows with the quantiles of a normal distribution times `spread`, and among them `far` of the
/// size `size`; how many are given less weight.
Eigen::Index lowered(int far, double size, double spread = 1.0) {
  const auto [rows, residual] = rows_of(2000, [&](Eigen::Index k) {
    // Spread over all: rows go by instruments.
    const double p = (static_cast<double>((k * 7) % 2000) + 0.5) / 2000.0;
    return k < far ? size : spread * boost::math::quantile(boost::math::normal(), p);
  });
  const VecX weight = robust_weights(rows, residual);
  const Eigen::Index count = (weight.array() < 1.0).count();
  if (count > 0 && far > 0) {
    EXPECT_NEAR(weight[0], spread / size, 0.3 / size);  // as large as it is
  }
  return count;
}

TEST(Thresholds, OutliersAreWorthTheirTwoNumbersAndNotTooMany) {
  EXPECT_EQ(lowered(0, 0.0), 0);
  EXPECT_EQ(lowered(1, 4.0), 0);  // one in 16,000 samples: of 2000 one in eight such tests
  EXPECT_EQ(lowered(1, 10.0), 1);
  EXPECT_EQ(lowered(8, 10.0), 8);
  EXPECT_EQ(lowered(20, 10.0), 20);
  EXPECT_EQ(lowered(42, 10.0), 0);  // 2.1 %
}

TEST(Thresholds, NoiseMoreThanATenthAboveTheDeclaredIsItsOwnMeasure) {
  EXPECT_EQ(lowered(0, 0.0, 1.5), 0);
  EXPECT_EQ(lowered(8, 15.0, 1.5), 8);
}

TEST(Thresholds, NoiseIsSaidToBeNotAsDeclaredAtOneInAThousand) {
  // Residuals that alternate by a have second differences of 4 a, all alike: the factor follows.
  constexpr Eigen::Index n = 1000;
  const auto significant = [](double z) {
    const double error = 1.0 / std::sqrt(2.0 * 0.37 * 0.5 * static_cast<double>(n - 2));
    const double a = std::exp(z * error) * std::sqrt(0.4549 * 6.0) / 4.0;
    const auto [rows, residual] = rows_of(n, [&](Eigen::Index k) { return k % 2 == 0 ? a : -a; });
    return noise_of_differences(rows, residual).findings.at(0).significant;
  };
  EXPECT_FALSE(significant(3.25));  // two-sided 1.15e-3
  EXPECT_TRUE(significant(3.33));   // 0.87e-3
}

}  // namespace
}  // namespace drift::inference::thresholds_test
