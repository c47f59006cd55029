// What identify says of a chi-square that the priors make, and of one that the data make.
#include "analysis/report/strapdown/case_misfit.hpp"

#include <gtest/gtest.h>

#include "analysis/identification/beyond_prior.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/strapdown/case_report.hpp"
#include "analysis/strapdown/sensed.hpp"
#include "tests/support/case_unit.hpp"

namespace drift::report::case_misfit_test {
namespace {

using strapdown::CaseIdentification;

/// Ten parameters that the data know, each so many prior sigmas from its prior; data of 1010
/// numbers with this chi-square per degree of freedom, of which the parameters leave 1000.
CaseIdentification fitted(double sigmas, double of_data) {
  CaseIdentification id;
  EstimateResult& e = id.fits.emplace_back().fit.estimate;
  for (const char* key :
       {"D_F_x", "D_F_y", "D_F_z", "s_x", "s_y", "s_z", "eta_x", "eta_y", "eta_z", "K0_x"}) {
    const std::size_t param = *TermLibrary::find(key);
    const double sigma = TermLibrary::specs[param].prior_si().sigma();
    e.parameters.push_back({param, 0.0, sigmas * sigma, 1e-9 * sigma, 0.0, sigma});
  }
  e.measured = 1010;
  e.statistic = 1000.0 * of_data + 10.0 * sigmas * sigmas;
  return id;
}

TEST(CaseMisfit, IsJudgedWithoutWhatPriorsCost) {
  const EstimateResult alone =
      identification::of_data_alone(fitted(20.0, 1.0).fits.front().fit.estimate);
  EXPECT_EQ(alone.measured, 1000u);
  EXPECT_NEAR(alone.statistic, 1000.0, 1e-6);
  EXPECT_EQ(misfit_of(fitted(0.0, 1.0)), CaseMisfit::none);
  EXPECT_EQ(misfit_of(fitted(20.0, 1.0)), CaseMisfit::of_priors);
  // 1000 degrees of freedom scatter by 0.0447 (FitLimits::misfit: five of these).
  EXPECT_EQ(misfit_of(fitted(20.0, 1.22)), CaseMisfit::of_priors);
  EXPECT_EQ(misfit_of(fitted(20.0, 1.23)), CaseMisfit::of_model);
  EXPECT_EQ(misfit_of(fitted(0.0, 1.5)), CaseMisfit::of_model);
}

TEST(CaseMisfit, OfPriorsSaysWhichHowFarAndWhatToSet) {
  CaseIdentification id = fitted(20.0, 1.0);
  ParameterEstimate& s_y = id.fits.front().fit.estimate.parameters[4];
  s_y.value *= 1.5;
  id.fits.front().fit.estimate.statistic += 30.0 * 30.0 - 20.0 * 20.0;
  const std::string said = case_misfit_text(id, misfit_of(id));
  EXPECT_EQ(said.find("Misfit of priors alone: "), 0u) << said;
  EXPECT_NE(said.find("10 parameters lie up to 30 prior sigmas from the means of their priors"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("(s_y, "), std::string::npos) << "the farthest first: " << said;
  EXPECT_EQ(said.find("no number below"), std::string::npos) << said;
  const std::string next = case_next(id, misfit_of(id));
  EXPECT_NE(next.find("s_y = { normal = [\"0 ppm\", \"30000 ppm\"] }"), std::string::npos) << next;
  EXPECT_NE(case_misfit_text(fitted(0.0, 1.5), CaseMisfit::of_model).find("no number below"),
            std::string::npos);
}

/// A unit a hundred times as far from its priors as a good one, its model exactly true.
TEST(CaseMisfit, OfAUnitFarFromItsPriorsNoNumberIsCalledWrong) {
  Theta theta = 100.0 * strapdown::case_unit::sensors();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"})
    theta[static_cast<Eigen::Index>(*TermLibrary::find(key))] *= 0.01;
  const mc::Study study = mc::read_study_text(
      test::strapdown_study(
          fmt::format("{} deg", strapdown::case_unit::site.latitude / unit::deg.to_si),
          "9.8 m/s^2"),
      "study.toml");
  const CaseIdentification id = strapdown::identify_case(
      study, strapdown::case_study(
                 study, test::strapdown_recording(strapdown::case_unit::script(75), theta)));
  const EstimateResult& estimate = id.fits.front().fit.estimate;
  ASSERT_TRUE(identification::misfit(estimate)) << estimate.statistic_per_dof();
  EXPECT_EQ(misfit_of(id), CaseMisfit::of_priors)
      << identification::of_data_alone(estimate).statistic_per_dof();
  // Its numbers are right: of 24 each within 4.5 of its sigmas, by chance in all but 1 of 6000.
  for (const ParameterEstimate& p : strapdown::as_sensed(estimate).parameters)
    EXPECT_NEAR(p.value, theta[static_cast<Eigen::Index>(p.param)], 4.5 * p.sigma)
        << TermLibrary::specs[p.param].key.view();
  const InBrief brief = case_report(study, id).brief;
  EXPECT_EQ(brief.verdict.find("Misfit of priors alone: "), 0u) << brief.verdict;
  EXPECT_EQ(brief.tone, Tone::doubtful);
}

}  // namespace
}  // namespace drift::report::case_misfit_test
