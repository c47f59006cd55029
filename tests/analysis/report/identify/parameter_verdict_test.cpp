// What a parameter of an identification is worth, told apart on identifications made by hand.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/identification/beyond_prior.hpp"
#include "analysis/report/identify/sections.hpp"
#include "tests/analysis/report/identify/identification_fixture.hpp"

namespace drift::parameter_verdict_test {
namespace {

using report::Worth;

/// Filter 0 of the fixture: it fits, every sigma is a tenth of the prior's.
struct Fitted {
  mc::Study study = test::study();
  identification::Identification id = test::identification(study);

  ParameterEstimate& parameter(std::size_t k) { return id.runs[0].batch.estimate.parameters[k]; }
  report::ParameterVerdict verdict(std::size_t k) const {
    return report::verdict_of({study, id, id.summaries[0]}, k);
  }
};

TEST(ParameterVerdict, IsLearnedWhereTheDataSaySo) {
  EXPECT_EQ(Fitted().verdict(0).worth, Worth::learned);
}

TEST(ParameterVerdict, IsThePriorWhereLittleOfItWasTakenOff) {
  Fitted f;
  f.parameter(3).sigma = 0.81 * f.parameter(3).prior_sigma;
  EXPECT_EQ(f.verdict(3).worth, Worth::prior_only);
  f.parameter(3).sigma = 0.79 * f.parameter(3).prior_sigma;
  EXPECT_EQ(f.verdict(3).worth, Worth::learned);
}

TEST(ParameterVerdict, IsInASumAloneWhereThePriorDecidesMostOfItsVariance) {
  // Two parameters whose difference no datum sees: each keeps 1/2 of the prior's variance.
  Fitted f;
  VecX unseen = VecX::Zero(static_cast<Eigen::Index>(f.id.summaries[0].layout.size()));
  unseen[1] = unseen[2] = std::sqrt(0.5);
  f.id.summaries[0].unseen = {{0.0, unseen}};
  for (const std::size_t k : {1u, 2u})
    f.parameter(k).sigma = std::sqrt(0.5 + 0.01) * f.parameter(k).prior_sigma;
  EXPECT_EQ(f.verdict(1).worth, Worth::sum_only);
  EXPECT_EQ(f.verdict(2).worth, Worth::sum_only);
  EXPECT_EQ(f.verdict(0).worth, Worth::learned);
  const report::InBrief brief = report::identification_in_brief(f.study, f.id);
  const std::string said = fmt::format("{}", fmt::join(brief.more.texts(), "\n"));
  EXPECT_NE(said.find("2 known in sums with others alone"), std::string::npos) << said;
}

TEST(ParameterVerdict, IsLearnedWhateverDecidesTheRestOfAVarianceThatIsSmall) {
  // A hundredth of the prior's sigma is left, all of it along a direction that no datum sees.
  Fitted f;
  VecX unseen = VecX::Zero(static_cast<Eigen::Index>(f.id.summaries[0].layout.size()));
  unseen[1] = 0.01;
  unseen[2] = std::sqrt(1.0 - 0.01 * 0.01);
  f.id.summaries[0].unseen = {{0.0, unseen}};
  f.parameter(1).sigma = 0.01 * f.parameter(1).prior_sigma;
  EXPECT_EQ(f.verdict(1).worth, Worth::learned);
}

TEST(ParameterVerdict, WhatToDoNextIsOfTheTestAsItWas) {
  Fitted f;
  const auto next = [&] { return report::identification_in_brief(f.study, f.id).next; };
  const auto learn_nothing = [&](std::size_t run) {
    ParameterEstimate& p = f.id.runs[run].batch.estimate.parameters[3];
    p.sigma = 0.99 * p.prior_sigma;
  };
  ASSERT_NE(f.id.runs.back().filter, 0u);
  learn_nothing(f.id.runs.size() - 1);  // `rank` proposes positions for the first filter
  EXPECT_EQ(next().find("driftscope rank"), std::string::npos) << next();
  learn_nothing(0);
  EXPECT_NE(next().find("driftscope rank STUDY --improve 3 -o out/rank proposes"),
            std::string::npos)
      << next();
  EXPECT_EQ(next().find("readout"), std::string::npos) << next();
  f.id.absent = {"gimbal_outer", "gimbal_middle", "gimbal_inner"};
  EXPECT_NE(next().find("--set readout.gimbals=false"), std::string::npos) << next();
  f.id.absent_positions = {4};
  EXPECT_EQ(next().find("Next: record position 4"), 0u) << next();
}

TEST(ParameterVerdict, WhatToDoNextRunsWhereAFilterNeedsTheTemperature) {
  // A plan has no temperature unless [environment] says one: rank alone would end with exit 4.
  Fitted f;
  f.parameter(3).sigma = 0.99 * f.parameter(3).prior_sigma;
  const auto next = [&] { return report::identification_in_brief(f.study, f.id).next; };
  EXPECT_NE(next().find("driftscope rank"), std::string::npos) << next();
  EXPECT_EQ(next().find("environment.temperature"), std::string::npos) << next();
  f.study.filters.front().active[TermLibrary::index("kT_x")] = true;
  EXPECT_NE(next().find("--set environment.temperature="), std::string::npos) << next();
  f.study.environment[covariate("temperature")].mean[0] = 20.0;
  EXPECT_EQ(next().find("environment.temperature"), std::string::npos) << next();
}

TEST(ParameterVerdict, IsWrongBeyondFiveSigmaOfAKnownTruth) {
  Fitted f;
  f.parameter(4).value += 6.0 * f.parameter(4).sigma;
  EXPECT_EQ(f.verdict(4).worth, Worth::wrong);
  EXPECT_NEAR(f.verdict(4).off, 6.0, 1e-9);
}

TEST(ParameterVerdict, IsNotWrongWhereTheTruthHasNoSuchValue) {
  Fitted f;
  f.parameter(4).value += 6.0 * f.parameter(4).sigma;
  const std::size_t param = f.id.summaries[0].layout.params[4];
  f.id.truth->theta[static_cast<Eigen::Index>(param)] = std::nan("");
  EXPECT_EQ(f.verdict(4).worth, Worth::learned);
}

TEST(ParameterVerdict, IsNotToBeTrustedWhereTheFilterMisfits) {
  Fitted f;
  f.id.runs[0].batch.estimate.statistic = 3000.0;  // of 1000 scalars
  EXPECT_EQ(f.verdict(0).worth, Worth::untrusted);
}

TEST(ParameterVerdict, DependsOnTheStartWhereTheStartsDisagree) {
  Fitted f;
  f.id.summaries[0].spread[5].ekf = 20.0;  // of the estimator that does not count
  EXPECT_NE(f.verdict(5).worth, Worth::start_dependent);
  f.id.summaries[0].spread[5].counted = 20.0;
  EXPECT_EQ(f.verdict(5).worth, Worth::start_dependent);
}

TEST(FitWords, TheWordOfAFitFollowsFromTheBandBesideIt) {
  Fitted f;  // 95 % of right models with 1000 degrees of freedom are within 0.914 to 1.090
  EstimateResult& r = f.id.runs[0].batch.estimate;
  const auto word = [&](double statistic) {
    r.statistic = statistic;
    return report::fit_cell(r).text;
  };
  EXPECT_EQ(word(1089.0), "ok");
  EXPECT_EQ(word(1095.0), "outside the band");
  EXPECT_EQ(word(905.0), "outside the band");
  // 5 sigma: sqrt(2 / 1000) times 5 is 0.2236.
  EXPECT_EQ(word(1222.0), "outside the band");
  EXPECT_EQ(word(1225.0), "misfit");
  EXPECT_EQ(word(778.0), "outside the band");
  EXPECT_EQ(word(775.0), "less noise");
  r.noise_at_most = true;
  EXPECT_EQ(word(775.0), "outside the band");
  r.noise_at_most = false;
  r.statistic = 1150.0;
  const std::string said = fmt::format(
      "{}", fmt::join(report::identification_in_brief(f.study, f.id).more.texts(), "\n"));
  EXPECT_NE(said.find("Filter corrected: chi-square per degree of freedom 1.150 is outside the 95 "
                      "% band of a right model, 0.914 to 1.090 (so far by chance: 0.001)"),
            std::string::npos)
      << said;
}

TEST(FitWords, AFitWithLessNoiseThanDeclaredStands) {
  Fitted f;
  f.id.runs[0].batch.estimate.statistic = 292.0;  // of 1000 scalars
  // Every sigma is a tenth of its prior's: of each parameter 0.99 scalars were taken.
  const double taken = 0.99 * static_cast<double>(f.id.summaries[0].layout.size());
  f.id.runs[0].batch.data_chi2 = 0.25 * (1000.0 - taken);
  EXPECT_EQ(f.verdict(0).worth, Worth::learned);
  report::InBrief brief = report::identification_in_brief(f.study, f.id);
  EXPECT_EQ(brief.verdict,
            "Fits, with less noise than declared: the residuals are about 0.5 times what [readout] "
            "declares from filter corrected (chi-square per degree of freedom 0.292, 1 expected); "
            "filter legacy leaves more (chi-square per degree of freedom 1.01). The estimates "
            "stand, their sigmas are too wide. The noise is smaller than declared.");
  EXPECT_EQ(brief.tone, report::Tone::doubtful);
  EXPECT_NE(brief.next.find("declare that in [readout]"), std::string::npos) << brief.next;
  const std::string said = fmt::format("{}", fmt::join(brief.more.texts(), "\n"));
  EXPECT_EQ(said.find("not to be trusted"), std::string::npos) << said;
  EXPECT_EQ(said.find("a small effect is missing"), std::string::npos) << said;
  const report::Json json = report::identification_document(f.study, f.id);
  EXPECT_EQ(json["filters"][0]["fit"], "less_noise");
  EXPECT_NEAR(json["filters"][0]["noise_of_declared"], 0.5, 1e-9);
  EXPECT_EQ(json["filters"][1]["fit"], "ok");
  EXPECT_TRUE(json["filters"][1]["noise_of_declared"].is_null());
  // What a recording made of it may be joined rows.
  f.id.simulated = false;
  brief = report::identification_in_brief(f.study, f.id);
  EXPECT_NE(brief.verdict.find("or rows were joined whose noise is not white"), std::string::npos)
      << brief.verdict;
  // Somewhat below the band nothing is missing either.
  f.id.runs[0].batch.estimate.statistic = 850.0;
  const std::string below = fmt::format(
      "{}", fmt::join(report::identification_in_brief(f.study, f.id).more.texts(), "\n"));
  EXPECT_NE(below.find("noise is less, or priors are narrower"), std::string::npos) << below;
}

TEST(FitWords, ParametersFarFromTheirPriorsAreSaid) {
  Fitted f;
  const auto said = [&] {
    return fmt::format(
        "{}", fmt::join(report::identification_in_brief(f.study, f.id).more.texts(), "\n"));
  };
  f.id.truth.reset();
  f.parameter(3).value = f.parameter(3).prior_mean + 4.9 * f.parameter(3).prior_sigma;
  EXPECT_EQ(said().find("of their prior sigmas"), std::string::npos) << said();
  f.parameter(3).value = f.parameter(3).prior_mean - 5.1 * f.parameter(3).prior_sigma;
  f.parameter(4).value = f.parameter(4).prior_mean + 9.0 * f.parameter(4).prior_sigma;
  EXPECT_NE(said().find("2 parameters lie further than 5 of their prior sigmas"), std::string::npos)
      << said();
  EXPECT_EQ(report::beyond_prior({f.study, f.id, f.id.summaries[0]}).size(), 2u);
  EXPECT_EQ(report::identification_in_brief(f.study, f.id).tone, report::Tone::doubtful);
}

TEST(FitWords, AParameterFarFromItsPriorIsToBeExaminedByADiagnosis) {
  // The farthest of all lies beyond the limit (3.3 prior sigmas or so) with a chance of 5 %.
  Fitted f;
  f.id.truth.reset();
  f.id.simulated = false;
  f.id.sources = {"r.csv"};
  f.parameter(5).sigma = 0.99 * f.parameter(5).prior_sigma;  // learned nothing of: `rank`
  const std::size_t of = f.id.runs[0].batch.estimate.parameters.size();
  const double limit = identification::farthest_by_chance(of, inference::FitLimits::far_from_prior);
  EXPECT_NEAR(identification::chance_of_farthest(of, limit), 0.05, 1e-9);
  const auto put = [&](double sigmas) {
    f.parameter(3).value = f.parameter(3).prior_mean + sigmas * f.parameter(3).prior_sigma;
    return report::identification_in_brief(f.study, f.id);
  };
  EXPECT_NE(put(limit - 0.01).next.find("driftscope rank"), std::string::npos);
  const report::InBrief brief = put(-limit - 0.01);
  const std::string key = report::parameter_key(f.parameter(3).param);
  EXPECT_NE(brief.next.find("driftscope diagnose"), std::string::npos) << brief.next;
  EXPECT_NE(brief.next.find("behind " + key), std::string::npos) << brief.next;
  const std::string said = fmt::format("{}", fmt::join(brief.more.texts(), "\n"));
  EXPECT_NE(said.find("far from the mean of its prior: " + key), std::string::npos) << said;
  // So far that no prior has it: the graver words, and the same step.
  EXPECT_NE(put(9.0).next.find("driftscope diagnose"), std::string::npos);
}

TEST(FitWords, TheFirstSentenceSaysWhichInstrumentsWereMissing) {
  Fitted f;
  const auto verdict = [&] { return report::identification_in_brief(f.study, f.id).verdict; };
  EXPECT_EQ(verdict().find("alone"), std::string::npos) << verdict();
  f.id.absent = {"acc_x", "acc_y", "acc_z"};
  EXPECT_NE(verdict().find("gimbal angles alone: the recording has no accelerometers (acc_x, "
                           "acc_y, acc_z)"),
            std::string::npos)
      << verdict();
  f.id.absent = {"gimbal_outer", "gimbal_middle", "gimbal_inner"};
  EXPECT_NE(verdict().find("accelerometers alone: the recording has no gimbal angles"),
            std::string::npos)
      << verdict();
  f.id.absent = {"acc_z"};
  EXPECT_NE(verdict().find("without acc_z: the recording has no acc_z"), std::string::npos)
      << verdict();
}

}  // namespace
}  // namespace drift::parameter_verdict_test
