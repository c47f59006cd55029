// A recording with less noise than [readout] declares: its estimates are those of before.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/report/identify/sections.hpp"

namespace drift::less_noise_test {
namespace {

constexpr std::string_view study_text = R"(schema = 1
[site]
latitude = "45 deg"
[plan]
dwell = "90 min"
sample = "3 min"
mode = "free"
[[plan.position]]
axes = "x=N y=W z=U"
[[plan.position]]
axes = "x=U y=N z=W"
[readout]
accelerometer_noise = "5 ug"
gimbal_noise = "5 arcsec"
[truth]
coupling = "eq6"
terms = ["fixed_drift", "g_drift"]
[[filter]]
name = "f"
coupling = "eq6"
terms = ["fixed_drift", "g_drift"]
starts = [{}]
[monte_carlo]
runs = 1
seed = 9
)";

/// The study with noise declared so many times larger than it was.
mc::Study declared(double times) {
  mc::Study study = mc::read_study_text(study_text, "s.toml");
  study.readout.accelerometer_noise *= times;
  study.readout.gimbal_noise *= times;
  return study;
}

const Recording& recording() {
  static const Recording made =
      identification::identify_simulated(declared(1.0), 0, 1).recordings.front();
  return made;
}

TEST(LessNoise, ThanDeclaredIsNoMisfitAndItsFactorIsSaid) {
  const mc::Study study = declared(2.0);
  const auto id = identification::identify_recordings(study, {recording()}, 1);
  const EstimateResult& result = id.runs.front().batch.estimate;
  ASSERT_LT(result.statistic_per_dof(), 0.4);
  EXPECT_FALSE(identification::misfit(result));
  EXPECT_TRUE(identification::less_noise(result));
  EXPECT_NEAR(identification::noise_of_declared(study.filters.front(), id.runs.front()), 0.5, 0.06);
  const report::InBrief brief = report::identification_in_brief(study, id);
  EXPECT_EQ(brief.verdict.find("Fits, with less noise than declared:"), 0u) << brief.verdict;
  EXPECT_NE(brief.verdict.find("The estimates stand"), std::string::npos) << brief.verdict;
  const report::Report page = report::identification_report(study, id);
  EXPECT_NE(report::to_text(page).find("less noise"), std::string::npos);
  for (const std::string& said : {report::to_text(page), report::to_html(page)})
    EXPECT_EQ(said.find("not to be trusted"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(page.document.second)["filters"][0]["fit"], "less_noise");
}

TEST(LessNoise, EstimatesAreThoseOfTheNoiseAsItIsWithinTheSigmasOfThat) {
  const mc::Study is = declared(1.0), wide = declared(2.0);
  const auto of = [](const mc::Study& study) {
    return identification::identify_recordings(study, {recording()}, 1)
        .runs.front()
        .batch.estimate.parameters;
  };
  const std::vector<ParameterEstimate> a = of(is), b = of(wide);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_LT(std::abs(a[k].value - b[k].value), 2.0 * a[k].sigma) << k;
    EXPECT_GT(b[k].sigma, 0.99 * a[k].sigma) << k;
  }
}

TEST(LessNoise, MoreNoiseThanDeclaredStaysAMisfit) {
  const mc::Study study = declared(0.5);
  const auto id = identification::identify_recordings(study, {recording()}, 1);
  EXPECT_TRUE(identification::misfit(id.runs.front().batch.estimate));
  EXPECT_FALSE(identification::less_noise(id.runs.front().batch.estimate));
  EXPECT_EQ(report::identification_in_brief(study, id).verdict.find("Misfit:"), 0u);
}

}  // namespace
}  // namespace drift::less_noise_test
