// Correlations of estimates and their map.
#include "analysis/report/identify/correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/report/identify/sections.hpp"
#include "tests/analysis/report/figures_of.hpp"
#include "tests/analysis/report/identify/identification_fixture.hpp"
#include "tests/analysis/report/xml_check.hpp"

namespace drift::correlation_test {
namespace {

using namespace report;

TEST(Correlation, OfASumThatAloneIsKnown) {
  // Prior 1 on each of two, and a measurement of x + y with variance v: information I + [1 1; 1
  // 1]/v, covariance by hand, correlation -1 / (1 + v).
  EstimateResult result;
  const double v = 0.25;
  MatX information = MatX::Identity(3, 3);
  information.topLeftCorner(2, 2).array() += 1.0 / v;
  result.covariance = information.inverse();
  const MatX r = correlation_of(result);
  EXPECT_NEAR(r(0, 1), -1.0 / (1.0 + v), 1e-12);
  EXPECT_NEAR(r(2, 0), 0.0, 1e-12);
  EXPECT_NEAR(r(2, 2), 1.0, 1e-12);
  const auto pairs = strongest_pairs(r);
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].one, 0u);
  EXPECT_EQ(pairs[0].other, 1u);
}

TEST(CorrelationMap, ShowsTheStrongestAndSaysThem) {
  const mc::Study study = test::study();
  identification::Identification id = test::identification(study);
  const auto n = static_cast<Eigen::Index>(id.summaries[0].layout.size());
  MatX P = MatX::Identity(n, n);
  P(3, 7) = P(7, 3) = -0.97;
  P(1, 2) = P(2, 1) = 0.4;
  for (auto& run : id.runs) run.batch.estimate.covariance = 0.01 * P;
  const FilterView view{study, id, id.summaries[0]};
  const Section section = correlations(view);
  const auto figures = test::figures_of({section});
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_FALSE(test::xml_problem(figures[0].svg, {}));
  EXPECT_NE(figures[0].svg.find("-0.97"), std::string::npos);
  const auto& said = std::get<Paragraph>(section.blocks[1].content).text;
  EXPECT_NE(said.find(fmt::format("1 pair is correlated by more than 0.9, of which a sum or "
                                  "difference is known better than either: {} and {} -0.970.",
                                  parameter_key(view.summary.layout, 3),
                                  parameter_key(view.summary.layout, 7))),
            std::string::npos)
      << said;
  // Uncorrelated, but one sum is not seen: no parameter is said to be known by itself.
  for (auto& run : id.runs) {
    run.batch.estimate.covariance = MatX::Identity(n, n);
    run.batch.information_root = MatX::Identity(n, n);
    run.batch.information_root(0, 0) = 0.0;
  }
  id.summaries[0].unseen = {{0.0, VecX::Unit(n, 0)}};
  EXPECT_EQ(
      std::get<Paragraph>(correlations(view).blocks[1].content).text,
      fmt::format("No two parameters are correlated by more than 0.9; of {} directions of the "
                  "parameters 1 is not seen at all.",
                  n));
  id.summaries[0].unseen.clear();
  EXPECT_EQ(std::get<Paragraph>(correlations(view).blocks[1].content).text,
            "No two parameters are correlated by more than 0.9.");
  for (auto& run : id.runs) run.batch.estimate.covariance.resize(0, 0);
  EXPECT_TRUE(correlations(view).blocks.empty());  // it failed before there was one
}

}  // namespace
}  // namespace drift::correlation_test
