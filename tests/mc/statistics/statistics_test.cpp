// Statistics of synthetic blocks, whose numbers are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/rng.hpp"
#include "mc/statistics/point_statistics.hpp"
#include "mc/statistics/stop_rule.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::statistics_test {
namespace {

using namespace drift::test;
using C = mc::StudyColumns;

TEST(ErrorStatistics, HasClosedForms) {
  // Errors 1, -3 with sigmas 1, 2 in units of a prior of 10.
  mc::ErrorStatistics e(10.0);
  e.add(1.0, 1.0);
  e.add(-3.0, 2.0);
  EXPECT_DOUBLE_EQ(e.bias().value, -1.0);
  // SD of {1, -3} is sqrt(8), known from one degree of freedom: Student's t is Cauchy's.
  EXPECT_NEAR(e.bias().half_width(),
              std::tan(0.475 * std::numbers::pi) * std::sqrt(8.0) / std::sqrt(2.0), 1e-10);
  EXPECT_NEAR(e.bias(0.5).half_width(), std::sqrt(8.0) / std::sqrt(2.0), 1e-12);
  EXPECT_DOUBLE_EQ(e.rmse().value, std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(e.mean_sigma(), std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(e.deception().value, std::sqrt(2.0));
  EXPECT_EQ(e.coverage()[0].hits, 0u);  // 1 is not below 1 sigma
  EXPECT_EQ(e.coverage()[1].hits, 2u);
  EXPECT_DOUBLE_EQ(e.learning(), std::sqrt(2.5) / 10.0);
}

/// Share of `trials` studies of n runs each whose interval of the RMSE (or of the deception ratio,
/// with sigmas that are off by up to a half) holds the true one. Errors: bias + normal.
double held(std::size_t n, double bias, bool of_ratio, std::uint64_t seed) {
  constexpr int trials = 2000;
  // E (sigma^2) of sigma = 0.5 + u, u uniform on (0, 1): 13/12.
  const double truth = std::sqrt((1.0 + bias * bias) / (of_ratio ? 13.0 / 12.0 : 1.0));
  int inside = 0;
  for (int t = 0; t < trials; ++t) {
    Stream stream(seed, static_cast<std::uint64_t>(t), Purpose::test);
    mc::ErrorStatistics e(7.0);
    for (std::size_t run = 0; run < n; ++run)
      e.add(bias + stream.normal(), of_ratio ? 0.5 + stream.uniform() : 1.0);
    const mc::Estimated found = of_ratio ? e.deception() : e.rmse();
    inside += found.low <= truth && truth <= found.high ? 1 : 0;
  }
  return static_cast<double>(inside) / trials;
}

TEST(IntervalsOfFewRuns, HoldNinetyOneToNinetySixOfAHundred) {
  // The scatter of 2,000 trials is 0.5 %: three of it on either side of these.
  for (const std::size_t n : {2u, 3u, 5u, 10u, 30u, 100u})
    for (const double bias : {0.0, 3.0})
      for (const bool of_ratio : {false, true}) {
        const double share = held(n, bias, of_ratio, 41 + n);
        EXPECT_GT(share, 0.91 - 0.015) << n << " " << bias << " " << of_ratio;
        EXPECT_LT(share, 0.96 + 0.015) << n << " " << bias << " " << of_ratio;
      }
}

TEST(IntervalsOfFewRuns, AreThoseOfManyInTheEnd) {
  // 2000 normal errors: 1 +- 1.96 / sqrt(2 n) = +- 0.031.
  mc::ErrorStatistics e(1.0);
  Stream stream(1, 0, Purpose::test);
  for (int run = 0; run < 2000; ++run) e.add(stream.normal(), 1.0);
  EXPECT_NEAR(e.rmse().half_width(), 1.96 / std::sqrt(4000.0), 0.1 * 0.031);
  EXPECT_NEAR(e.deception().half_width(), e.rmse().half_width(), 0.1 * 0.031);
}

TEST(IntervalsOfFewRuns, OfOneThereIsNone) {
  mc::ErrorStatistics e(1.0);
  e.add(2.0, 1.0);
  EXPECT_TRUE(std::isnan(e.rmse().low) && std::isnan(e.deception().high));
  EXPECT_NEAR(e.sigmas_above(), 1.69, 0.01) << "2 sigma on either side: 4.55 %";
}

TEST(DistributionBins, HoldFiveOfAHundredEachWhereTheNumbersFollow) {
  // The middles of 100 equal shares of chi-square of 2 degrees, whose quantile is -2 log(1 - p).
  mc::DistributionBins bins;
  for (int k = 0; k < 100; ++k)
    bins.add(mc::chi_square_probability(-2.0 * std::log1p(-(k + 0.5) / 100.0), 2.0));
  for (std::size_t b = 0; b < mc::DistributionBins::size; ++b) {
    EXPECT_EQ(bins.in(b).hits, 5u) << b;
    EXPECT_DOUBLE_EQ(bins.up_to(b).value(), 0.05 * static_cast<double>(b + 1)) << b;
  }
  bins.add(mc::chi_square_probability(1e6, 2.0));
  bins.add(std::nan(""));  // no number: not counted
  EXPECT_EQ(bins.in(19).hits, 6u);
  EXPECT_EQ(bins.total(), 101u);
}

TEST(DistributionBins, OfMagnitudesAreThoseOfTheErrorFunction) {
  for (const double z : {0.0, 0.05, 0.7, -1.5, 1.9, 2.5, -40.0}) {
    const double p = std::erf(std::abs(z) / std::sqrt(2.0));
    const double bin = std::min(19.0, std::floor(20.0 * p));
    EXPECT_DOUBLE_EQ(mc::magnitude_probability(z), (bin + 0.5) / 20.0) << z;
  }
}

TEST(ErrorStatistics, CoverageAgreesWithTheBinsOfItsErrors) {
  // 95 % are within 1.96 sigma: the first nineteen bins; counted here a second way.
  mc::ErrorStatistics e(1.0);
  Stream stream(3, 0, Purpose::test);
  std::uint64_t within = 0;
  for (int run = 0; run < 1000; ++run) {
    const double error = stream.normal();
    within += std::abs(error) < 2.0 * stats::half_width_95 ? 1 : 0;
    e.add(error, 2.0);
  }
  EXPECT_EQ(e.magnitudes().up_to(18).hits, within);
  EXPECT_EQ(e.magnitudes().total(), 1000u);
}

TEST(RateCourse, RemembersTheRateAtEveryTenthMore) {
  mc::RateCourse course;
  stats::Rate rate;
  for (int run = 1; run <= 1000; ++run) {
    rate.count(run % 4 == 0);
    course.follow(rate);
  }
  const auto& steps = course.steps();
  EXPECT_LT(steps.size(), 70u);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    EXPECT_EQ(steps[k].hits, steps[k].of / 4);
    if (k < 20) {
      EXPECT_EQ(steps[k].of, k + 1);
    } else {
      EXPECT_EQ(steps[k].of, steps[k - 1].of + steps[k - 1].of / 10);
    }
  }
}

/// A block of a study point, filled by hand: every run a perfect estimate at first.
struct Synthetic {
  mc::Study study = read_text(small_study);
  C columns{study};
  mc::Block block;

  explicit Synthetic(std::size_t runs) {
    block.status.assign(runs, mc::RunStatus::ok);
    block.rows.assign(runs * columns.count, 0.0);
    for (std::size_t r = 0; r < runs; ++r)
      for (const auto& f : columns.filters)
        for (std::size_t s = 0; s < f.starts; ++s) {
          at(r, f.at(s, C::nis)) = 1000.0;
          at(r, f.at(s, C::nis_dof)) = 1000.0;
          at(r, f.at(s, C::nees)) = at(r, f.at(s, C::nees_dof)) = 8.0;
          at(r, f.at(s, C::nees_all)) = static_cast<double>(f.layout.size());
          for (std::size_t k = 0; k < f.layout.size(); ++k)
            at(r, f.sigma(s, k)) = 0.1 * f.layout.sigma[static_cast<Eigen::Index>(k)];
        }
  }
  double& at(std::size_t run, std::size_t column) {
    return block.rows[run * columns.count + column];
  }
  /// An error of `sigmas` in parameter k of the first filter, first start.
  void put_off(std::size_t run, std::size_t k, double sigmas) {
    const auto& f = columns.filters[0];
    at(run, f.estimate(0, k)) = at(run, f.truth[k]) + sigmas * at(run, f.sigma(0, k));
  }
};

TEST(SilentFailure, IsARunThatIsWrongWhereItClaimsToKnowAndLooksHealthy) {
  Synthetic s(10);
  const auto& f = s.columns.filters[0];
  s.put_off(0, 2, 6.0);   // silent
  s.put_off(1, 2, -6.0);  // silent, the other way
  s.put_off(2, 2, 4.9);   // not far enough off
  s.put_off(3, 2, 6.0);
  s.at(3, f.at(0, C::nis)) = 1200.0;  // wrong, but NIS shows it (band of 1000: 0.914 to 1.090)
  s.at(4, f.sigma(0, 2)) = 0.6 * f.layout.sigma[2];
  s.put_off(4, 2, 6.0);              // does not claim to know
  s.at(5, f.at(0, C::nis)) = 800.0;  // unhealthy, but right: NIS too good counts too
  s.put_off(6, 2, 6.0);
  s.put_off(6, 3, 6.0);               // one run, two parameters
  s.at(7, f.at(0, C::status)) = 2.0;  // diverged: wrong, and not silent
  mc::PointStatistics statistics(s.study);
  statistics.add(s.block);
  const auto& filter = statistics.filters()[0];
  const auto& start = filter.starts()[0];
  EXPECT_EQ(start.silent.hits, 3u);
  EXPECT_EQ(start.silent.of, 10u);
  EXPECT_EQ(start.wrong.hits, 5u);
  EXPECT_EQ(start.healthy.hits, 7u);
  EXPECT_EQ(start.diverged.hits, 1u);
  EXPECT_EQ(filter.health()[2].silent.hits, 3u);
  EXPECT_EQ(filter.health()[3].silent.hits, 1u);
  EXPECT_EQ(filter.health()[2].claims.hits, 8u);
  EXPECT_EQ(filter.starts()[1].silent.hits, 0u);
  EXPECT_EQ(statistics.filters()[1].starts()[0].silent.hits, 0u);
  EXPECT_EQ(filter.errors()[2].runs(), 9u);
}

TEST(StartConsistency, IsTheSpreadOfStartsOverTheirSigma) {
  Synthetic s(4);
  const auto& f = s.columns.filters[0];
  const double sigma = s.at(0, f.sigma(0, 1));
  for (std::size_t r = 0; r < 4; ++r) {
    s.at(r, f.estimate(0, 1)) = -3.0 * sigma;
    s.at(r, f.estimate(1, 1)) = 3.0 * sigma;  // SD of two values 6 sigma apart: 6 / sqrt(2)
  }
  mc::PointStatistics statistics(s.study);
  statistics.add(s.block);
  EXPECT_NEAR(statistics.filters()[0].health()[1].start_ratio(), 6.0 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(statistics.filters()[0].health()[1].start_depends.hits, 0u);
  EXPECT_TRUE(std::isnan(statistics.filters()[1].health()[1].start_ratio()));
}

TEST(Failures, AreTiedToTheParameterThatCausesThem) {
  Synthetic s(1000);
  // Failing where the first truth parameter is in its highest tenth; its prior is normal(0, sigma).
  const std::size_t column = 0, other = 1;
  const auto prior = [&](std::size_t c) { return s.study.truth.priors[s.columns.truth[c]].b; };
  Stream stream(1, 0, Purpose::test);
  for (std::size_t r = 0; r < 1000; ++r) {
    const double z = stream.normal();
    s.at(r, column) = z * prior(column);
    s.at(r, other) = stream.normal() * prior(other);
    if (z > 1.2815515655446004) s.block.status[r] = mc::RunStatus::integrator_failed;
  }
  mc::PointStatistics statistics(s.study);
  statistics.add(s.block);
  const auto& failures = statistics.failures();
  const auto deciles = failures.deciles();
  EXPECT_EQ(deciles[0].rate[9].value(), 1.0);
  EXPECT_EQ(deciles[0].rate[0].value(), 0.0);
  EXPECT_NEAR(deciles[0].chi2, 1000.0,
              120.0);                // all variance explained: n, but for the drawn count
  EXPECT_LT(deciles[1].chi2, 27.9);  // 99.9 % of chi-square with 9 degrees
  EXPECT_TRUE(failures.too_many());
  EXPECT_EQ(failures.first_failed().size(), 20u);
  EXPECT_EQ(statistics.filters()[0].starts()[0].nis.in_band.of, 1000 - failures.lost().hits);
}

TEST(PointStatistics, DoNotDependOnHowRunsAreCutIntoBlocks) {
  const mc::StudyTask task(read_text(small_study));
  const auto worker = task.worker();
  mc::PointStatistics whole(task.study()), parts(task.study());
  whole.add(run_block(task, *worker, 0, 30));
  for (const std::uint64_t first : {0u, 10u, 20u}) parts.add(run_block(task, *worker, first, 10));
  for (std::size_t k = 0; k < whole.filters()[0].errors().size(); ++k) {
    const auto &a = whole.filters()[0].errors()[k], &b = parts.filters()[0].errors()[k];
    EXPECT_EQ(a.rmse().value, b.rmse().value);
    EXPECT_EQ(a.rmse().low, b.rmse().low);
    EXPECT_EQ(a.deception().high, b.deception().high);
  }
  EXPECT_EQ(whole.filters()[0].starts()[0].nis.sum, parts.filters()[0].starts()[0].nis.sum);
}

TEST(StopRule, StopsWhenTheIntervalIsNarrowEnough) {
  const mc::Study study =
      read_text(small_study + "stop = { quantity = \"silent_failure_rate\", half_width = 0.01 }\n");
  const auto points = mc::study_points(study);
  mc::HalfWidthRule rule(points, *study.monte_carlo.stop);
  Synthetic s(64);
  std::uint64_t runs = 0;
  bool enough = false;
  while (!enough && runs < 1000) {
    s.block.first = runs;
    enough = rule.enough(s.block);
    runs += 64;
  }
  // No failures: the Wilson half width z^2 / (2 (n + z^2)) is 0.01 at n = 188.2.
  EXPECT_EQ(runs, 192u);
  EXPECT_NEAR(rule.half_width(0), 3.841459 / (2.0 * (192.0 + 3.841459)), 1e-9);
  EXPECT_EQ(mc::stop_rule(mc::study_points(read_text(small_study))), nullptr);
}

TEST(StopRule, WaitsForAnRmse) {
  const mc::Study study = read_text(
      small_study + "stop = { quantity = \"rmse.eta_x\", half_width = 0.005, confidence = 0.9 }\n");
  const auto points = mc::study_points(study);
  const auto rule = mc::stop_rule(points);
  const auto index = [&](const Synthetic& s) {
    const auto& params = s.columns.filters[0].layout.params;
    return static_cast<std::size_t>(std::ranges::find(params, TermLibrary::index("eta_x")) -
                                    params.begin());
  };
  Stream stream(2, 0, Purpose::test);
  std::uint64_t runs = 0;
  bool enough = false;
  while (!enough && runs < 4000) {
    Synthetic s(64);
    for (std::size_t r = 0; r < 64; ++r) s.put_off(r, index(s), stream.normal());
    s.block.first = runs;
    enough = rule->enough(s.block);
    runs += 64;
  }
  // Errors of 0.1 prior sigma: half width 1.645 * 0.1 / sqrt(2 n) is 0.005 at n = 541; the estimate
  // of the spread is good to 10 % there, n to 20 %.
  EXPECT_NEAR(static_cast<double>(runs), 541.0, 140.0);
}

}  // namespace
}  // namespace drift::statistics_test
