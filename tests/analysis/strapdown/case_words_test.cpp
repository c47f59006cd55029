// What the answer says of a fit that nothing could be held out of.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/report/strapdown/case_report.hpp"
#include "analysis/strapdown/case_identify.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::case_words_test {
namespace {

mc::Study of_twelve_dwells() {
  return mc::read_study_text(test::strapdown_study("45.75 deg", "9.8 m/s^2"), "study.toml");
}

/// A unit without errors, held twelve times.
CaseIdentification identified(const mc::Study& study) {
  test::StrapdownScript script;
  script.dwells = 12;
  script.omega_ie_l = study.site.omega_ie_l();
  return identify_case(study, case_study(study, strapdown_recording(script, Theta::Zero())));
}

TEST(CaseWords, WhatHasNoNumberIsNotSaid) {
  const mc::Study study = of_twelve_dwells();
  CaseIdentification id = identified(study);
  const auto said = [&] {
    return fmt::format("{}", fmt::join(report::case_report(study, id).brief.more.texts(), "\n"));
  };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  ASSERT_GT(id.fits.front().up.count, 0u);
  EXPECT_NE(said().find("Up after a turn that was held out: "), std::string::npos) << said();
  EXPECT_NE(said().find("; gyros in dwells held out: "), std::string::npos) << said();
  id.fits.front().up.held_out = none;
  EXPECT_EQ(said().find("Up after a turn"), std::string::npos) << said();
  EXPECT_NE(said().find("Gyros in dwells held out: "), std::string::npos) << said();
  id.fits.front().gyro.held_out = none;
  EXPECT_EQ(said().find("held out"), std::string::npos) << said();
  EXPECT_EQ(said().find("- deg"), std::string::npos) << said();
}

/// One per cent more of g than there is: identify says it, as diagnose does.
TEST(CaseWords, AGravityThatIsOffIsSaidByBothCommands) {
  const mc::Study study =
      mc::read_study_text(test::strapdown_study("45.75 deg", "9.8 m/s^2"), "study.toml");
  test::StrapdownScript script;
  script.dwells = 16;
  script.rest = 10.0;
  script.turn = 8.0;
  script.gyro_noise = 3e-6;
  script.acc_noise = 1e-4;
  script.omega_ie_l = study.site.omega_ie_l();
  const Recording right = strapdown_recording(script, Theta::Zero());
  Recording wrong = right;
  for (Channel& c : wrong.channels)
    if (c.name.starts_with("acc_"))
      for (double& force : c.values) force *= 1.01;
  const auto brief_of = [&](const Recording& r) {
    return report::case_report(study, identify_case(study, case_study(study, r))).brief;
  };
  const auto said = [](const report::InBrief& brief) {
    return fmt::format("{}\n{}\n{}", brief.verdict, fmt::join(brief.more.texts(), "\n"),
                       brief.next);
  };
  EXPECT_EQ(said(brief_of(right)).find("ravity"), std::string::npos) << said(brief_of(right));
  const report::InBrief brief = brief_of(wrong);
  for (const char* words :
       {"Gravity: K1_x, K1_y and K1_z are larger alike: of readings in m/s^2 a site.gravity that "
        "is",
        "Next: correct site.gravity, or the unit of the accelerometers, and identify again."})
    EXPECT_NE(said(brief).find(words), std::string::npos) << said(brief);
  EXPECT_EQ(brief.verdict.find("something is missing"), std::string::npos) << said(brief);
}

/// Noise that nothing explains is a misfit whatever the gravity: it is not of priors alone.
TEST(CaseWords, AMisfitBesideAGravityThatIsOffStaysOne) {
  const mc::Study study = of_twelve_dwells();
  CaseIdentification id = identified(study);
  EstimateResult& estimate = id.fits.front().fit.estimate;
  for (ParameterEstimate& p : estimate.parameters)
    if (TermLibrary::specs[p.param].group.view() == "K1")
      p.value = p.prior_mean + 20.0 * p.prior_sigma;
  const double fits = static_cast<double>(estimate.measured);
  estimate.statistic = fits + 1200.0;
  EXPECT_TRUE(report::case_report(study, id).brief.verdict.starts_with("Misfit of priors alone"))
      << report::case_report(study, id).brief.verdict;
  estimate.statistic = 5.0 * fits + 1200.0;
  const report::InBrief brief = report::case_report(study, id).brief;
  EXPECT_TRUE(brief.verdict.starts_with("Misfit: ")) << brief.verdict;
  EXPECT_NE(brief.next.find("driftscope diagnose"), std::string::npos) << brief.next;
  EXPECT_TRUE(std::ranges::any_of(
      brief.more.texts(), [](const std::string& text) { return text.starts_with("Gravity: "); }));
}

/// A navigation-grade unit of a laboratory at `latitude` [rad], turned by 0.5 to the West of North.
Recording of_a_laboratory(double latitude) {
  test::StrapdownScript script;
  script.dwells = 16;
  script.rest = 10.0;
  script.turn = 8.0;
  script.gyro_noise = 3e-6;
  script.acc_noise = 1e-4;
  script.omega_ie_l = Site{latitude, 9.8}.omega_ie_l();
  script.attitude = case_attitude(0.5);
  return strapdown_recording(script, Theta::Zero());
}

TEST(CaseWords, WhereNorthIsIsToldWithItsSigmaAndAllParametersWithTheirCovariance) {
  const mc::Study study =
      mc::read_study_text(test::strapdown_study("45.75 deg", "9.8 m/s^2"), "study.toml");
  const CaseIdentification id =
      identify_case(study, case_study(study, of_a_laboratory(study.site.latitude)));
  const report::Report said = report::case_report(study, id);
  const std::string text = fmt::format("{}", fmt::join(said.brief.more.texts(), "\n"));
  EXPECT_NE(text.find("in the first dwell the x axis of the case points 33"), std::string::npos)
      << text;
  const auto json = nlohmann::json::parse(said.document.second);
  const auto& azimuth = json.at("azimuth");
  EXPECT_EQ(azimuth.at("axis"), "x");
  const double sigma = azimuth.at("sigma_deg").get<double>();
  EXPECT_EQ(sigma, json.at("azimuth_sigma_deg").get<double>());
  EXPECT_NEAR(azimuth.at("from_north_to_east_deg").get<double>(), 360.0 - 0.5 / unit::deg.to_si,
              5.0 * sigma);
  const auto table = std::ranges::find(said.files, "covariance.csv",
                                       [](const auto& f) { return std::string(f.first); });
  ASSERT_NE(table, said.files.end());
  const std::size_t n = id.fits.front().fit.estimate.parameters.size();
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(table->second, '\n')),
            1 + id.fits.size() * n * (n + 1) / 2);
  const StrapdownParameter& p = id.fits.front().parameters.front();
  const auto at = table->second.find(fmt::format(",1,batch,{0},{0},{1},{1},", p.key, p.unit));
  ASSERT_NE(at, std::string::npos) << table->second.substr(0, 400);
  const std::string line = table->second.substr(at, table->second.find('\n', at) - at);
  const auto before = line.rfind(',', line.rfind(',') - 1);
  EXPECT_NEAR(std::stod(line.substr(before + 1)), p.sigma * p.sigma, 1e-9 * p.sigma * p.sigma);
}

TEST(CaseWords, OfAWrongLatitudeItIsNotSaidThatTheGyrosDoNotSeeTheEarth) {
  const mc::Study study =
      mc::read_study_text(test::strapdown_study("45 deg", "9.8 m/s^2"), "study.toml");
  const CaseIdentification id = identify_case(study, of_a_laboratory(34.0 * unit::deg.to_si));
  ASSERT_TRUE(id.latitude);
  ASSERT_FALSE(id.study.compass.sees_earth);
  const report::InBrief brief = report::case_report(study, id).brief;
  const std::string text = fmt::format("{}", fmt::join(brief.more.texts(), "\n"));
  EXPECT_NE(brief.verdict.find("the gyros at rest see the Earth as it turns at 3"),
            std::string::npos)
      << brief.verdict;
  EXPECT_EQ(text.find("The gyros do not see the Earth"), std::string::npos) << text;
  EXPECT_NE(text.find("At 45.000 deg, the latitude of the study, what the gyros read at rest is "
                      "not the Earth's rate"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace drift::strapdown::case_words_test
