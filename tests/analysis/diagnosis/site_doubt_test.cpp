#include "analysis/diagnosis/doubts/site_doubt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::diagnosis::site_doubt_test {
namespace {

constexpr double truth = 45.75;  // deg, of test::harbin

/// Six positions of free drift at Harbin, and a study that may say another latitude.
struct Scene : test::SixWithHidden {
  explicit Scene(double latitude_deg, double hidden = 0.0) : SixWithHidden(std::nullopt, hidden) {
    study.site.latitude = latitude_deg * unit::deg.to_si;
  }
  std::optional<identification::LatitudeDoubt> doubt(Verdict verdict) const {
    Diagnosis d;
    d.nominal = study.filters.front();
    d.verdict = verdict;
    return site_doubt(study, {recording}, d).doubt;
  }
};

TEST(SiteDoubt, FindsTheLatitudeBehindAMisfit) {
  for (const double declared : {46.5, 30.0, 70.0, 89.0, 0.1}) {
    const auto doubt = Scene(declared).doubt(Verdict::unexplained);
    ASSERT_TRUE(doubt) << declared;
    EXPECT_NEAR(doubt->latitude / unit::deg.to_si, truth, 0.05)
        << declared;  // six positions know it to 0.01 deg or so
    EXPECT_NEAR(doubt->chi2_per_dof_after, 1.0, 0.2) << declared;
    EXPECT_GT(doubt->chi2_per_dof_before, doubt->chi2_per_dof_after);
    EXPECT_TRUE(doubt->alone()) << doubt->chance_after;
    EXPECT_NEAR(doubt->prior_sigmas(), std::abs(declared - truth) * 3600.0 / 20.0, 9.0)
        << declared;  // 0.05 deg
    Diagnosis told;
    told.site_doubt = doubt;
    EXPECT_EQ(report::sentence(told).find("The latitude of [site] is not that of the recording"),
              0u);
    // Four words are fixed for the JSON; a reader is not told "unexplained" of what is explained.
    told.verdict = Verdict::unexplained;
    const report::InBrief brief = report::diagnosis_in_brief(told);
    EXPECT_EQ(brief.verdict.find(doubt->or_clock ? "Verdict wrong latitude or times: "
                                                 : "Verdict wrong latitude: "),
              0u)
        << brief.verdict;
    EXPECT_TRUE(brief.more.empty());
    EXPECT_EQ(nlohmann::json::parse(report::to_json(told))["verdict"], "unexplained");
    EXPECT_NEAR(nlohmann::json::parse(report::to_json(told))["latitude"]["of_recording_deg"], truth,
                0.05);
  }
}

TEST(SiteDoubt, ALatitudeThatDoesNotMendTheFitAloneIsNotAdvisedAsIfItDid) {
  // 1.5 deg and, of a hundredth of that misfit, a drift that no parameter of the filter describes.
  const Scene s(truth + 1.5, 0.3);
  const auto doubt =
      identification::latitude_doubt(s.study, {s.recording}, s.study.filters.front());
  ASSERT_TRUE(doubt);
  EXPECT_GT(doubt->chi2_per_dof_after, 1.5);
  EXPECT_FALSE(doubt->alone()) << doubt->chance_after;
  Diagnosis told;
  told.verdict = Verdict::unexplained;
  told.site_doubt = doubt;
  const report::InBrief brief = report::diagnosis_in_brief(told);
  EXPECT_EQ(brief.verdict.find("Verdict wrong latitude and more: "), 0u) << brief.verdict;
  EXPECT_NE(brief.verdict.find("Something else is missing too"), std::string::npos);
  EXPECT_EQ(brief.next.find("--set site.latitude"), std::string::npos) << brief.next;
  const auto json = nlohmann::json::parse(report::to_json(told));
  EXPECT_EQ(json["latitude"]["alone"], false);
}

TEST(SiteDoubt, AnEffectBesideAnotherLatitudeIsFoundThereAndNoSizeOfHundredsIsNamed) {
  // Without the effect the latitude leaves something; isotropic kappas of hundreds of their usual
  // sizes, or the field's, leave nothing and stand for both.
  test::SixWithHidden of(std::nullopt, 0.3);
  PlanDefaults defaults;
  defaults.dwell = 1200.0;
  defaults.sample = 60.0;
  of.study.plan = preset_plan("twelve", defaults).value();
  const Recording recording = of.recorded(0.3);
  of.study.site.latitude = (truth + 1.5) * unit::deg.to_si;
  DiagnoseOptions options;
  options.starts = 1;
  options.whiteness_draws = 0;
  Diagnosis d = diagnose(of.study, {recording}, options);
  const SiteFinding site = site_doubt(of.study, {recording}, d, options);
  ASSERT_TRUE(site.doubt) << report::sentence(d);
  ASSERT_TRUE(site.there) << report::sentence(d);
  EXPECT_FALSE(site.doubt->alone());
  EXPECT_NEAR(site.doubt->latitude / unit::deg.to_si, truth,
              4.0 * site.doubt->sigma / unit::deg.to_si);
  ASSERT_FALSE(site.there->causes.empty());
  EXPECT_EQ(site.there->causes.front().term, "g2_drift");
  d.site_doubt = site.doubt;
  d.there = site.there;
  const std::string told = report::sentence(d);
  EXPECT_EQ(told.find("The latitude of [site] is not that of the recording"), 0u) << told;
  EXPECT_NE(told.find("and that is not all"), std::string::npos) << told;
  EXPECT_NE(told.find("There: "), std::string::npos) << told;
  EXPECT_NE(told.find("g2_drift"), std::string::npos) << told;
  const auto json = nlohmann::json::parse(report::to_json(d));
  EXPECT_EQ(json["at_that_latitude"]["causes"][0]["term"], "g2_drift");
}

TEST(SiteDoubt, WithoutOneTheFirstOfSeveralMissingEffectsIsWhatToDoNext) {
  Diagnosis told;
  told.verdict = Verdict::unexplained;
  EXPECT_EQ(report::diagnosis_in_brief(told).next, "");
  told.remarks.push_back(
      remark::StrongestLeft{{"accelerometer K0", "g2_drift"}, "temperature_drift"});
  const std::string next = report::diagnosis_in_brief(told).next;
  EXPECT_NE(next.find("terms+=accelerometer\""), std::string::npos) << next;
  // No single effect of the library fits: that does not make them several.
  EXPECT_NE(next.find("more than one effect, or one of another shape, seems"), std::string::npos)
      << next;
}

TEST(SiteDoubt, IsFoundWhereAnEffectFarBeyondItsUsualSizeTakesItUp) {
  // On free and on slewed plans latitude_error, or a twin under a prior as wide as what was found,
  // fits the test and leaves nothing to ask for.
  DiagnoseOptions options;
  options.starts = 1;
  options.whiteness_draws = 0;
  for (const auto& [preset, declared] :
       {std::pair{"twelve", 43.75}, std::pair{"twelve", 40.75}, std::pair{"slew12", 43.75},
        std::pair{"twelve", -30.0}, std::pair{"six", 44.75}, std::pair{"twelve", 89.0},
        std::pair{"twelve", 0.1}}) {
    mc::Study study = test::six_study();
    PlanDefaults defaults;
    defaults.dwell = std::string_view(preset) == "six" ? 2400.0 : 1200.0;
    defaults.sample = 60.0;
    study.plan = preset_plan(preset, defaults).value();
    const Recording recording = test::simulated(study);
    study.site.latitude = declared * unit::deg.to_si;
    const Diagnosis d = diagnose(study, {recording}, options);
    ASSERT_NE(d.verdict, Verdict::consistent) << preset << declared;
    const auto doubt = site_doubt(study, {recording}, d).doubt;
    ASSERT_TRUE(doubt) << preset << declared << report::sentence(d);
    EXPECT_TRUE(doubt->alone()) << doubt->chance_after;
    // Six positions of 40 min know it to 0.03 deg, the others to a thousandth.
    EXPECT_NEAR(doubt->latitude / unit::deg.to_si, truth, 0.1) << preset << declared;
  }
}

TEST(SiteDoubt, TellsWhatElseItMayBe) {
  Diagnosis d;
  d.verdict = Verdict::named;
  search::Cause step;
  step.term = "mass_unbalance_step";
  step.axis = "y";
  d.causes.push_back(step);
  identification::LatitudeDoubt doubt;
  doubt.latitude = 45.75 * unit::deg.to_si;
  doubt.declared = 45.25 * unit::deg.to_si;
  doubt.sigma = 0.01 * unit::deg.to_si;
  const auto says = [&](const char* part) {
    return report::sentence(d).find(part) != std::string::npos;
  };
  d.other_latitude = doubt;
  EXPECT_TRUE(says("The nominal model lacks step of the mass unbalance"));
  EXPECT_TRUE(
      says("Another latitude would explain it, too (45.750±0.01 deg instead of 45.250 deg)"));
  d.other_latitude.reset();
  d.site_doubt = doubt;
  d.site_doubt->odds = 7.4;
  EXPECT_TRUE(says("If a map confirms the latitude of [site], it is step of the mass unbalance"))
      << report::sentence(d);
  d.site_doubt->odds = 20.0;
  EXPECT_FALSE(says("mass unbalance"));
}

TEST(SiteDoubt, IsNotRaisedWhereTheLatitudeIsRightOrTheVerdictGivesNoReason) {
  EXPECT_FALSE(Scene(truth).doubt(Verdict::unexplained));
  EXPECT_FALSE(Scene(47.0).doubt(
      Verdict::named));  // latitude_error is no strong candidate of this diagnosis
}

TEST(SiteDoubt, TheWrongHemisphereHidesInParametersFarFromTheirPriorsAndIsStillFound) {
  // Earth rate about Up is isotropic D_I: the residuals are clean, the parameters are not.
  const Scene s(-truth);
  DiagnoseOptions options;
  options.starts = 1;
  options.whiteness_draws = 0;
  const Diagnosis d = diagnose(s.study, {s.recording}, options);
  EXPECT_TRUE(std::ranges::any_of(d.remarks, [](const auto& r) {
    return report::in_words(r).find("D_I_x, D_I_y, D_I_z") != std::string::npos;
  }));
  const auto doubt = site_doubt(s.study, {s.recording}, d).doubt;
  ASSERT_TRUE(doubt) << report::sentence(d);
  EXPECT_NEAR(doubt->latitude / unit::deg.to_si, truth, 0.05);
  const Diagnosis right = diagnose(Scene(truth).study, {s.recording}, options);
  EXPECT_TRUE(std::ranges::none_of(
      right.remarks, [](const auto& r) { return std::holds_alternative<remark::BeyondPrior>(r); }));
}

TEST(SiteDoubt, TheWrongHemisphereIsFoundBesideACause) {
  // Three D_I, and more, are far from their priors, and with room there nothing would be missing.
  DiagnoseOptions options;
  options.starts = 1;
  options.whiteness_draws = 0;
  const auto beyond = [](const Diagnosis& d) {
    return std::ranges::any_of(
        d.remarks, [](const auto& r) { return std::holds_alternative<remark::BeyondPrior>(r); });
  };
  const Scene wrong(-truth, 0.3), right(truth, 0.3);
  Diagnosis d = diagnose(wrong.study, {wrong.recording}, options);
  EXPECT_TRUE(beyond(d));
  const SiteFinding site = site_doubt(wrong.study, {wrong.recording}, d, options);
  ASSERT_TRUE(site.doubt) << report::sentence(d);
  EXPECT_NEAR(site.doubt->latitude / unit::deg.to_si, truth, 0.05);
  ASSERT_TRUE(site.there);
  ASSERT_FALSE(site.there->causes.empty());
  EXPECT_EQ(site.there->causes.front().term, "g2_drift");
  d.site_doubt = site.doubt;
  d.there = site.there;
  const std::string told = report::sentence(d);
  EXPECT_EQ(told.find("The latitude of [site] is not that of the recording"), 0u) << told;
  EXPECT_NE(told.find("There: The nominal model lacks g^2-sensitive drift"), std::string::npos)
      << told;
  const Diagnosis of_right = diagnose(right.study, {right.recording}, options);
  EXPECT_EQ(of_right.verdict, Verdict::named) << report::sentence(of_right);
  EXPECT_FALSE(beyond(of_right));
  EXPECT_FALSE(site_doubt(right.study, {right.recording}, of_right).doubt);
}

TEST(LatitudeDoubt, IsRaisedByAnIdentificationThatMisfits) {
  const auto doubt_at = [](double declared) {
    const Scene s(declared);
    return identification::identify_recordings(s.study, {s.recording}, 1)
        .summaries.front()
        .latitude_doubt;
  };
  for (const double declared : {truth + 10.0, truth - 0.4}) {
    const auto doubt = doubt_at(declared);
    ASSERT_TRUE(doubt) << declared;
    EXPECT_NEAR(doubt->latitude / unit::deg.to_si, truth, 0.05) << declared;
  }
  EXPECT_FALSE(doubt_at(truth));
}

TEST(LatitudeDoubt, TheWrongHemisphereIsFoundWhateverElseMisfits) {
  Scene s(-truth);  // and an accelerometer that no parameter of the filter describes
  const std::vector<double>& x = s.recording.find("acc_x")->values;
  for (Channel& c : s.recording.channels)
    for (std::size_t i = 0; c.name == "acc_y" && i < x.size(); ++i)
      c.values[i] += 1e-4 * std::sin(40.0 * x[i]);
  const FilterSpec& filter = s.study.filters.front();
  const auto doubt = identification::latitude_doubt(s.study, {s.recording}, filter);
  ASSERT_TRUE(doubt);
  EXPECT_NEAR(doubt->latitude / unit::deg.to_si, truth, 0.2);
  EXPECT_GT(doubt->chi2_per_dof_after, 1.3);
  EXPECT_FALSE(doubt->alone());
  EXPECT_LT(doubt->chi2_per_dof_before - doubt->chi2_per_dof_after,
            inference::SiteLimits::most * (doubt->chi2_per_dof_before - 1.0))
      << "it does not explain the misfit";
  s.study.site.latitude = truth * unit::deg.to_si;
  EXPECT_FALSE(identification::latitude_doubt(s.study, {s.recording}, filter));
}

}  // namespace
}  // namespace drift::diagnosis::site_doubt_test
