// Which of several starts a filter is judged by, and what is said of the others.
#include "analysis/identification/counted_start.hpp"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/report/identify/sections.hpp"

namespace drift::counted_start_test {
namespace {

using identification::counted_start;
using identification::FilterRun;
using identification::Measured;

/// Two free positions under a filter whose fixed drift nobody knows.
mc::Study study(std::string_view starts, std::string_view prior) {
  return mc::read_study_text(fmt::format(R"(schema = 1
[site]
latitude = "45 deg"
[plan]
dwell = "30 min"
sample = "3 min"
mode = "free"
[[plan.position]]
axes = "x=N y=W z=U"
[[plan.position]]
axes = "x=U y=N z=W"
[readout]
accelerometer_noise = "10 ug"
gimbal_noise = "10 arcsec"
[truth]
coupling = "eq6"
terms = ["fixed_drift", "g_drift"]
[truth.parameters]
D_F_x = "0.3 deg/h"
[[filter]]
name = "f"
coupling = "eq6"
terms = ["fixed_drift", "g_drift"]
starts = {}
[filter.parameters]
D_F = {{ normal = ["0 deg/h", "{} deg/h"] }}
[monte_carlo]
runs = 1
seed = 9
)",
                                         starts, prior),
                             "s.toml");
}

struct Identified {
  mc::Study study;
  identification::Identification id = identification::identify_simulated(study, 0, 1);

  const FilterRun& counted() const { return id.counted(id.summaries.front()); }
  report::InBrief brief() const { return report::identification_in_brief(study, id); }
  std::string more() const { return fmt::format("{}", fmt::join(brief().more.texts(), "\n")); }
  nlohmann::json json() const {
    const std::string text = report::identification_report(study, id).document.second;
    return nlohmann::json::parse(text)["filters"][0];
  }
};

TEST(CountedStart, IsOneThatFitsWhereTheFirstEndsElsewhere) {
  // From 3000 deg/h the batch fit ends above 1e8 per degree of freedom, elsewhere at 0.992.
  const Identified of{study(
      R"([{ D_F_x = "3000 deg/h", D_F_y = "-2000 deg/h" }, {}, { D_F_x = "1 deg/h" }])", "100")};
  ASSERT_TRUE(identification::misfit(of.id.runs.front().batch.estimate));
  EXPECT_EQ(of.counted().start, 1u);
  EXPECT_EQ(of.brief().verdict.find("Fits"), 0u) << of.brief().verdict;
  EXPECT_NE(of.more().find("Filter f: start 2 counts, the batch fit of least chi-square of those "
                           "that converged; 2 of 3 starts end there within their sigmas."),
            std::string::npos)
      << of.more();
  // The EKF's answer depends on the start: that is in its table. That of the two that fit does not.
  EXPECT_EQ(of.more().find("dependent on the start"), std::string::npos) << of.more();
  const auto json = of.json();
  EXPECT_EQ(json["counted_start"], 2);
  EXPECT_EQ(json["agreeing_starts"], 2);
  EXPECT_EQ(json["starts"].size(), 3u);
  EXPECT_TRUE(json["beyond_prior"].empty());
  const report::Report page = report::identification_report(of.study, of.id);
  const std::string html = report::to_html(page);
  EXPECT_NE(html.find("the batch fit from start 2;"), std::string::npos);
  EXPECT_NE(html.find("batch: from start 2."), std::string::npos);
  EXPECT_NE(html.find("Posterior correlations, batch fit from start 2."), std::string::npos);
}

TEST(CountedStart, IsThePriorMeanWhereNoDrawnOneFits) {
  // Drawn with 10 000 deg/h the platform turns over within a sample.
  const Identified of{study("2", "10000")};
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_FALSE(identification::fits(of.id.runs[k].batch.estimate)) << k;
  ASSERT_EQ(of.id.runs.size(), 3u);
  EXPECT_EQ(of.counted().start, 2u);
  for (const ParameterEstimate& p : of.counted().batch.estimate.parameters)
    EXPECT_EQ(p.start, p.prior_mean);
  EXPECT_EQ(of.brief().verdict.find("Fits"), 0u) << of.brief().verdict;
  EXPECT_NE(of.more().find("start 3, the prior mean, tried as no drawn one fits, counts"),
            std::string::npos)
      << of.more();
  EXPECT_EQ(of.json()["counted_start"], 3);
}

TEST(CountedStart, NothingChangesWithOneThatFits) {
  const Identified one{study("1", "2")}, three{study("3", "2")};
  ASSERT_EQ(one.id.runs.size(), 1u);
  ASSERT_EQ(three.id.runs.size(), 3u);
  // All three end at one minimum: the first counts, and it is the one of a study with one.
  EXPECT_EQ(three.counted().start, 0u);
  EXPECT_EQ(three.id.summaries.front().agreeing_starts, 3u);
  EXPECT_EQ(one.counted().batch.estimate.statistic, three.counted().batch.estimate.statistic);
  for (const Identified* of : {&one, &three})
    EXPECT_EQ(of->more().find("counts, the batch fit"), std::string::npos) << of->more();
}

/// Runs of a filter with one parameter, of sigma 1 and prior sigma 10, as both estimators end.
struct Runs {
  std::vector<FilterRun> runs;

  void add(double value, double cost, EstimateStatus status = EstimateStatus::ok) {
    FilterRun run;
    EstimateResult r;
    r.status = status;
    r.parameters = {{TermLibrary::index("D_F_x"), 0.0, value, 1.0, 0.0, 10.0}};
    r.covariance = MatX::Constant(1, 1, 0.01);
    r.statistic = cost;
    r.measured = 100;
    run.ekf = run.batch.estimate = r;
    runs.push_back(run);
  }
  identification::CountedStart counted(const FilterSpec& filter,
                                       Measured measured = Measured::once) const {
    std::vector<const FilterRun*> all;
    for (const FilterRun& run : runs) all.push_back(&run);
    return counted_start(filter, all, measured);
  }
};

TEST(CountedStart, IsOfLeastCostAmongThoseThatConverged) {
  const FilterSpec filter;
  Runs of;
  of.add(0.0, 50.0, EstimateStatus::not_converged);
  of.add(20.0, 150.0);
  of.add(0.1, 100.4);
  of.add(0.0, 100.0);
  of.add(0.0, std::nan(""));
  // The third costs 0.4 more than the fourth: they are one, and the first of them is taken.
  EXPECT_EQ(of.counted(filter).start, 2u);
  EXPECT_EQ(of.counted(filter).agreeing, 2u);
  // Of tests of their own the costs say nothing: the first that converged.
  EXPECT_EQ(of.counted(filter, Measured::by_each_start).start, 1u);
  EXPECT_EQ(of.counted(filter, Measured::by_each_start).agreeing, 1u);
  Runs none;
  none.add(0.0, 100.0, EstimateStatus::diverged);
  none.add(0.0, 50.0, EstimateStatus::not_converged);
  EXPECT_EQ(none.counted(filter).start, 0u);
  EXPECT_EQ(none.counted(filter).agreeing, 0u);
}

TEST(CountedStart, WhatOneLeavesOutAsOutliersCostsTheGateSquared) {
  FilterSpec filter;
  constexpr auto gate = TermLibrary::index("outlier_gate");
  filter.active.set(gate);
  filter.priors[gate] = fixed(5.0);
  Runs of;
  of.add(0.0, 100.0);
  of.add(20.0, 90.0);
  EXPECT_EQ(of.counted(filter).start, 1u);
  of.runs[1].batch.estimate.measured -= 1;  // 90 + 25
  EXPECT_EQ(of.counted(filter).start, 0u);
}

TEST(CountedStart, OfAnEkfWhatItKeepsOfItsStartIsNoDisagreement) {
  FilterSpec filter;
  filter.noise.drift_random_walk = 1e-6;  // the EKF is judged
  // Nothing is learned: a linear filter keeps the start, 40 of a sigma of 10.
  Runs of;
  of.add(0.0, 100.0);
  of.add(40.0, 100.0);
  EXPECT_EQ(of.counted(filter).agreeing, 1u);
  of.runs[1].ekf.parameters[0].start = 40.0;
  for (FilterRun& run : of.runs) {
    run.ekf.parameters[0].sigma = 10.0;
    run.ekf.covariance = MatX::Constant(1, 1, 1.0);
  }
  EXPECT_EQ(of.counted(filter).agreeing, 2u);
  of.runs[1].ekf.parameters[0].value = 80.0;  // 40 off: 40 / (10 sqrt(2)) = 2.8, above 2
  EXPECT_EQ(of.counted(filter).agreeing, 1u);
}

}  // namespace
}  // namespace drift::counted_start_test
