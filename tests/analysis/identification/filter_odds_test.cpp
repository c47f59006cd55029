// Which of several filters that fit one test is to be believed, by how probable they are.
#include "analysis/identification/filter_odds.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/report/identify/judgement.hpp"

namespace drift::filter_odds_test {
namespace {

using identification::favoured;

/// Six free positions under eq. (5) and filters a and b, each by its equation and further lines.
mc::Study study(std::string_view a, std::string_view b, std::string_view more_a = "",
                std::string_view more_b = "", std::string_view truth = "") {
  const auto filter = [](char name, std::string_view equation, std::string_view more) {
    return fmt::format(R"([[filter]]
name = "{}"
coupling = "{}"
terms = ["fixed_drift", "g_drift", "gyro_misalignment", "accelerometer"]
{}
)",
                       name, equation, more);
  };
  return mc::read_study_text(fmt::format(R"(schema = 1
[site]
latitude = "45 deg"
[plan]
preset = "six"
dwell = "30 min"
sample = "3 min"
mode = "free"
entry = "caged"
[readout]
accelerometer_noise = "10 ug"
gimbal_noise = "10 arcsec"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "g_drift", "gyro_misalignment", "accelerometer"]
{}
{}{}[monte_carlo]
runs = 1
seed = 4
)",
                                         truth, filter('a', a, more_a), filter('b', b, more_b)),
                             "s.toml");
}

struct Identified {
  mc::Study study;
  identification::Identification id = identification::identify_simulated(study, 0, 1);

  double evidence(std::size_t filter) const {
    return identification::log_evidences(study, id)[filter].value();
  }
  const ParameterEstimate& K0_x(std::size_t filter) const {
    const EstimateResult& fit = id.counted(id.summaries[filter]).batch.estimate;
    return *fit.find(TermLibrary::find("K0_x").value());
  }
};

TEST(FilterOdds, APriorThatIsMovedCostsWhatItsDistanceFromTheDataDoes) {
  // The data alone have x +- s, whatever else is fitted: the evidence goes as
  // exp(-(x - m)^2 / 2 (S^2 + s^2)), and (x - m)^2 / (S^2 + s^2) is that of the fit over S^2 less
  // its variance. K0 is linear.
  const Identified i{study("eq5", "eq5", "parameters.K0_x = { normal = [\"0 ug\", \"100 ug\"] }",
                           "parameters.K0_x = { normal = [\"400 ug\", \"100 ug\"] }")};
  const auto cost = [&](std::size_t filter) {
    const ParameterEstimate& p = i.K0_x(filter);
    return std::pow(p.value - p.prior_mean, 2) /
           (std::pow(p.prior_sigma, 2) - std::pow(p.sigma, 2));
  };
  const double expected = -0.5 * (cost(0) - cost(1));
  ASSERT_GT(std::abs(expected), 1.0);
  EXPECT_NEAR(i.evidence(0) - i.evidence(1), expected, 1e-3 * std::abs(expected));
}

TEST(FilterOdds, FiltersThatSayTheSameAreAsProbable) {
  const Identified i{study("eq5", "eq5")};
  EXPECT_NEAR(i.evidence(0), i.evidence(1), 1e-9 * std::abs(i.evidence(0)));
  EXPECT_FALSE(favoured(i.study, i.id, {0, 1}));
  EXPECT_FALSE(favoured(i.study, i.id, {0})) << "there is nothing to choose";
}

/// Misalignments of a minute of arc: the wrong equation fits as well.
constexpr std::string_view small = R"([truth.parameters]
eta = "60 arcsec"
xi = "60 arcsec"
)";

TEST(FilterOdds, OfTwoThatFitTheMoreProbableIsBelieved) {
  for (const bool first : {true, false}) {
    const Identified i{first ? study("eq5", "eq6", "", "", small)
                             : study("eq6", "eq5", "", "", small)};
    const report::Judgement j = report::judgement_of(i.study, i.id);
    ASSERT_EQ(j.good.size(), 2u) << "both fit";
    ASSERT_TRUE(j.favoured) << i.evidence(0) << " " << i.evidence(1);
    EXPECT_EQ(j.favoured->filters, std::vector<std::size_t>{first ? 0u : 1u});
    EXPECT_EQ(j.first_favoured, first);
    EXPECT_NEAR(j.favoured->log_odds, std::abs(i.evidence(0) - i.evidence(1)), 1e-9);
    const report::InBrief brief = report::identification_in_brief(i.study, i.id);
    EXPECT_EQ(brief.verdict.find(first ? "Believe a: " : "Believe b: "), 0u) << brief.verdict;
    EXPECT_NE(brief.verdict.find("times as probable as"), std::string::npos) << brief.verdict;
    if (!first) {
      EXPECT_NE(brief.next.find("diagnose"), std::string::npos) << brief.next;
    }
  }
}

TEST(FilterOdds, TwoThatSayTheSameAreBelievedTogetherAgainstAThird) {
  mc::Study s = study("eq5", "eq6", "", "", small);
  s.filters.push_back(s.filters.front());
  s.filters.back().name = "a2";
  const Identified i{s};
  const auto two = favoured(i.study, i.id, {0, 1, 2});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->filters, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(two->others, std::vector<std::size_t>{1});
  EXPECT_NEAR(two->log_odds, std::log(2.0) + i.evidence(0) - i.evidence(1), 1e-6);
  const std::string verdict = report::identification_in_brief(i.study, i.id).verdict;
  EXPECT_EQ(verdict.find("Believe a and a2: the residuals are what they expect"), 0u) << verdict;
}

TEST(FilterOdds, AFreeLambdaIsAsProbableAsWhatItMayBeIsOnAverage) {
  // The test shows eq. (5), and as well any lambda with misalignments that are larger by as much:
  // a bent valley, on which the covariance of all parameters together says nothing of its volume.
  constexpr std::string_view large = R"([truth.parameters]
eta = "112 arcsec"
xi = "90 arcsec"
)";
  const Identified i{study("lambda", "eq5", "", "", large)};
  mc::Study s = study("lambda", "eq5", "", "", large);
  const Prior prior = s.filters.front().priors[closure_param];
  // Mean over the prior as a fit knows it, by the trapezoid rule.
  constexpr double step = 0.125;
  double sum = 0.0, most = -std::numeric_limits<double>::infinity();
  for (double lambda = -0.5; lambda < 1.51; lambda += step) {
    s.filters.front().priors[closure_param] = fixed(lambda);
    const double held = Identified{s}.evidence(0), z = (lambda - prior.mean()) / prior.sigma();
    most = std::max(most, held);
    sum += std::exp(held - i.evidence(1) - 0.5 * z * z) * step / prior.sigma();
  }
  const double mean = i.evidence(1) + std::log(sum / std::sqrt(2.0 * std::numbers::pi));
  EXPECT_LT(i.evidence(0), most);
  EXPECT_NEAR(i.evidence(0), mean, 0.25);  // slices hold a sixth of the mass each at most
}

TEST(FilterOdds, WhatTheAttitudesCostIsNotCompared) {
  // The wider prior of the attitudes pays nothing in the determinant of the parameters.
  mc::Study s = study("eq5", "eq5");
  s.filters.back().initial_attitude *= 10.0;
  const Identified i{s};
  EXPECT_FALSE(favoured(i.study, i.id, {0, 1}));
  EXPECT_FALSE(identification::log_evidences(i.study, i.id)[1]);
}

}  // namespace
}  // namespace drift::filter_odds_test
