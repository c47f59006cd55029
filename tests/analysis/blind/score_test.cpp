#include "analysis/blind/score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/blind/summary.hpp"
#include "analysis/report/blind/report.hpp"

namespace drift::blind::score_test {
namespace {

using diagnosis::Verdict;

KeyEntry hiding(Stratum stratum, std::vector<std::pair<std::string, std::string>> terms,
                double size = 8.0) {
  KeyEntry k;
  k.plan.number = 1;
  k.plan.stratum = stratum;
  for (const auto& [term, axis] : terms) {
    HiddenEffect e;
    e.term = term;
    e.axis = axis;
    e.size = size;
    k.effects.push_back(e);
  }
  return k;
}

/// An answer whose causes are (term, axis, set).
Answer answer(Verdict verdict, std::vector<std::tuple<std::string, std::string, int>> causes) {
  Answer a;
  a.number = 1;
  a.verdict = verdict;
  for (const auto& [term, axis, set] : causes) a.causes.push_back({term, axis, set, 1.0, {}});
  return a;
}

const KeyEntry magnetic = hiding(Stratum::single, {{"magnetic_drift", "y"}});

diagnosis::Probabilities believing(double consistent, double noise, double named, double outside) {
  diagnosis::Probabilities p{consistent, noise, outside, {}};
  p.named.push_back({{{"magnetic_drift", "y", "magnetic_drift.y"}}, named});
  return p;
}

TEST(BlindScore, WhatIsMostProbableIsRightIfItWasHidden) {
  const Belief named = belief_of(believing(0.2, 0.1, 0.6, 0.1));
  EXPECT_EQ(named.kind, Belief::Kind::named);
  EXPECT_EQ(named.probability, 0.6);
  EXPECT_TRUE(is_right(named, magnetic));
  EXPECT_FALSE(is_right(named, hiding(Stratum::single, {{"magnetic_drift", "x"}})));
  EXPECT_FALSE(is_right(named, hiding(Stratum::pair, {{"magnetic_drift", "y"}, {"sag", "z"}})));
  EXPECT_FALSE(is_right(named, hiding(Stratum::null, {})));
  EXPECT_FALSE(is_right(named, hiding(Stratum::outside, {{"burst", ""}})));
  EXPECT_TRUE(is_right(belief_of(believing(0.5, 0.1, 0.2, 0.2)), hiding(Stratum::null, {})));
  EXPECT_TRUE(is_right(belief_of(believing(0.1, 0.5, 0.2, 0.2)),
                       hiding(Stratum::wrong_noise, {{"markov_drift", ""}})));
  EXPECT_TRUE(
      is_right(belief_of(believing(0.1, 0.1, 0.3, 0.5)), hiding(Stratum::local, {{"burst", ""}})));
  EXPECT_EQ(belief_of({}).kind, Belief::Kind::none);
}

TEST(BlindScore, ReliabilityComparesWhatWasStatedWithWhatWasRight) {
  // Ten answers of 0.6, six of them right; ten of 0.97, five of them right: errors 0 and 0.47.
  std::vector<TrialScore> scores;
  for (int k = 0; k < 20; ++k) {
    const bool sure = k >= 10, right = k % 10 < (sure ? 5 : 6);
    Answer a = answer(Verdict::named, {{"magnetic_drift", right ? "y" : "x", 0}});
    a.belief = {
        Belief::Kind::named, sure ? 0.97 : 0.6, {{"magnetic_drift", right ? "y" : "x", ""}}};
    scores.push_back(score_trial(magnetic, answers_of(to_json(std::vector{a})).front()));
  }
  const Reliability s = summarise(scores).reliability;
  ASSERT_EQ(s.bins.size(), 2u);
  EXPECT_EQ(s.bins[0].right.k, 6u);
  EXPECT_NEAR(s.bins[1].stated, 0.97, 1e-12);
  EXPECT_NEAR(s.error, 0.5 * 0.47, 1e-12);
  // Binomial: the mean of |share - p| of ten at 0.6 and at 0.97, as a normal distribution has it.
  EXPECT_NEAR(s.error_by_chance,
              0.5 * std::sqrt(2.0 / std::numbers::pi / 10.0) *
                  (std::sqrt(0.6 * 0.4) + std::sqrt(0.97 * 0.03)),
              1e-12);
}

TEST(BlindScore, ARightNameIsExactAndInTheSet) {
  const TrialScore s = score_trial(magnetic, answer(Verdict::named, {{"magnetic_drift", "y", 0}}));
  EXPECT_TRUE(s.detected && s.exact && s.in_set && s.subsystem);
  EXPECT_FALSE(s.confidently_wrong || s.extra || s.unexplained);
  EXPECT_EQ(s.called, "magnetic_drift");
}

TEST(BlindScore, TheRightTermOnTheWrongAxisIsConfidentlyWrong) {
  const TrialScore s = score_trial(magnetic, answer(Verdict::named, {{"magnetic_drift", "x", 0}}));
  EXPECT_TRUE(s.confidently_wrong && s.subsystem);
  EXPECT_FALSE(s.exact || s.in_set);
}

TEST(BlindScore, ASetOfThreeHoldsItAndASetOfFourIsTooLarge) {
  Answer a = answer(Verdict::ambiguous,
                    {{"latitude_error", "", 0}, {"magnetic_drift", "y", 1}, {"g2_drift", "y", 2}});
  EXPECT_TRUE(score_trial(magnetic, a).in_set);
  EXPECT_FALSE(score_trial(magnetic, a).exact);
  EXPECT_FALSE(score_trial(magnetic, a).confidently_wrong);
  a.causes.push_back({"sag", "", 3, 0.1, {}});
  EXPECT_FALSE(score_trial(magnetic, a).in_set);
  EXPECT_TRUE(score_trial(magnetic, a).offered);
  a.causes.erase(a.causes.begin() + 1);
  EXPECT_FALSE(score_trial(magnetic, a).offered);
}

TEST(BlindScore, ARightCauseAmongOthersIsNeitherExactNorWrong) {
  const TrialScore s = score_trial(
      magnetic, answer(Verdict::named, {{"magnetic_drift", "y", 0}, {"drift_ramp", "x", 0}}));
  EXPECT_TRUE(s.extra && s.in_set);
  EXPECT_FALSE(s.exact || s.confidently_wrong);
}

TEST(BlindScore, APairNeedsBothInOneAlternative) {
  const KeyEntry pair = hiding(Stratum::pair, {{"magnetic_drift", "y"}, {"sag", "x"}});
  EXPECT_TRUE(
      score_trial(pair, answer(Verdict::named, {{"sag", "x", 0}, {"magnetic_drift", "y", 0}}))
          .exact);
  EXPECT_TRUE(score_trial(pair, answer(Verdict::ambiguous, {{"sag", "x", 0},
                                                            {"drift_ramp", "y", 0},
                                                            {"sag", "x", 1},
                                                            {"magnetic_drift", "y", 1}}))
                  .in_set);
  const TrialScore apart =
      score_trial(pair, answer(Verdict::ambiguous, {{"sag", "x", 0}, {"magnetic_drift", "y", 1}}));
  EXPECT_FALSE(apart.in_set || apart.exact);
  const TrialScore one = score_trial(pair, answer(Verdict::named, {{"sag", "x", 0}}));
  EXPECT_FALSE(one.exact || one.confidently_wrong);
}

TEST(BlindScore, OnANullEverythingButConsistentIsAFalseAlarm) {
  const KeyEntry null = hiding(Stratum::null, {});
  EXPECT_FALSE(score_trial(null, answer(Verdict::consistent, {})).false_alarm);
  EXPECT_TRUE(score_trial(null, answer(Verdict::unexplained, {})).false_alarm);
  EXPECT_TRUE(score_trial(null, answer(Verdict::named, {{"sag", "x", 0}})).false_alarm);
}

TEST(BlindScore, ARandomWalkMayBeNamedWhereThereIsOneAndNowhereElse) {
  const Answer walk = answer(Verdict::named, {{"drift_random_walk", "x", 0}});
  EXPECT_FALSE(
      score_trial(hiding(Stratum::wrong_noise, {{"drift_random_walk", ""}}), walk).false_alarm);
  EXPECT_TRUE(score_trial(hiding(Stratum::wrong_noise, {{"outliers", ""}}), walk).false_alarm);
  EXPECT_TRUE(score_trial(hiding(Stratum::null, {}), walk).false_alarm);
}

TEST(BlindScore, OutsideTheLibraryEveryNameIsWrong) {
  const KeyEntry outside = hiding(Stratum::outside, {{"chirp", "x"}}, 15.0);
  EXPECT_TRUE(score_trial(outside, answer(Verdict::unexplained, {})).unexplained);
  EXPECT_TRUE(
      score_trial(outside, answer(Verdict::named, {{"drift_ramp", "x", 0}})).confidently_wrong);
}

TEST(BlindScore, PullsAreInTheUnitOfTheKey) {
  KeyEntry key = magnetic;
  key.effects[0].parameters = {{"M_y", 0.010, "deg/h/gauss"}};
  Answer a = answer(Verdict::named, {{"magnetic_drift", "y", 0}});
  search::CauseParameter p;
  p.key = "M_y";
  p.value = 120.0;  // deg/h/T is 1e4 times smaller than deg/h/gauss
  p.sigma = 10.0;
  p.unit = "deg/h/T";
  a.causes[0].parameters = {p};
  const TrialScore s = score_trial(key, a);
  ASSERT_EQ(s.pulls.size(), 1u);
  EXPECT_NEAR(s.pulls[0].pull(), (0.012 - 0.010) / 0.001, 1e-9);
}

TEST(BlindScore, AFailedOrMissingAnswerCountsAgainstEveryShare) {
  const auto scores = score_trials({magnetic}, {});
  ASSERT_EQ(scores.size(), 1u);
  EXPECT_TRUE(scores[0].answer.failed);
  const Summary s = summarise(scores);
  EXPECT_EQ(s.failed, 1u);
  for (const Target& t : s.targets)
    if (t.goal == Goal::detected_at_8_sigma) {
      EXPECT_EQ(t.measured.n, 1u);
      EXPECT_EQ(t.measured.k, 0u);
    }
}

TEST(BlindScore, SharesOfASummaryAreThoseOfItsTrials) {
  std::vector<TrialScore> scores;
  for (int i = 0; i < 10; ++i)
    scores.push_back(
        score_trial(magnetic, i < 7 ? answer(Verdict::named, {{"magnetic_drift", "y", 0}})
                                    : answer(Verdict::consistent, {})));
  const Summary s = summarise(scores);
  ASSERT_EQ(s.power.size(), 1u);
  EXPECT_EQ(s.power[0].detected.k, 7u);
  EXPECT_EQ(s.power[0].exact.k, 7u);
  EXPECT_NEAR(s.power[0].theory, 0.99999775, 1e-6);  // Phi(8 - sqrt(11.6)) = Phi(4.594)
  ASSERT_EQ(s.confusion.rows.size(), 1u);
  EXPECT_EQ(s.confusion.columns, (std::vector<std::string>{"consistent", "magnetic_drift"}));
  EXPECT_EQ(s.confusion.rows[0].called, (std::vector<std::size_t>{3, 7}));
}

/// sag.x and accelerometer_cross.y, as an answer that knows them for twins.
Answer twins(double cosine) {
  Answer a = answer(Verdict::ambiguous, {{"sag", "x", 0}, {"accelerometer_cross", "y", 1}});
  a.causes[0].confusable_with = {{"accelerometer_cross", "y", cosine}, {"drift_ramp", "z", 0.8}};
  return a;
}

TEST(BlindScore, ATwinCountsAsTheSameCauseInAScoreOfItsOwn) {
  const KeyEntry sag = hiding(Stratum::single, {{"sag", "x"}}),
                 cross = hiding(Stratum::single, {{"accelerometer_cross", "y"}});
  EXPECT_TRUE(score_trial(sag, twins(-1.0)).exact_or_twin);
  EXPECT_FALSE(score_trial(sag, twins(-1.0)).exact);
  // As everywhere: cosine^2 above 0.999.
  EXPECT_TRUE(score_trial(sag, twins(0.9996)).exact_or_twin);
  EXPECT_FALSE(score_trial(sag, twins(0.9994)).exact_or_twin) << "alike is not the same trace";
  Answer wide = twins(-1.0);
  wide.causes[0].confusable_with[0].axis = "";
  EXPECT_FALSE(score_trial(sag, wide).exact_or_twin) << "like some mixture of all axes";
  // Whichever of the two says so, and whichever was hidden.
  EXPECT_TRUE(score_trial(cross, twins(-1.0)).exact_or_twin);
  // A third that is no twin, another axis, or one twin beside a cause that is not hidden: no.
  Answer more = twins(1.0);
  more.causes.push_back({"drift_ramp", "z", 2, 0.1, {}});
  EXPECT_FALSE(score_trial(sag, more).exact_or_twin);
  more.causes.back().set = 1;
  EXPECT_FALSE(score_trial(sag, more).exact_or_twin);
  EXPECT_FALSE(score_trial(hiding(Stratum::single, {{"sag", "z"}}), twins(1.0)).exact_or_twin);
  // What is exact is so here too; the one twin alone, named, is not what was hidden.
  EXPECT_TRUE(score_trial(sag, answer(Verdict::named, {{"sag", "x", 0}})).exact_or_twin);
  EXPECT_FALSE(score_trial(sag, answer(Verdict::ambiguous, {})).exact_or_twin);
  EXPECT_FALSE(
      score_trial(sag, answer(Verdict::named, {{"accelerometer_cross", "y", 0}})).exact_or_twin);
}

TEST(BlindScore, AnswersKeepWhatACauseIsLikeAndAreReadWithoutIt) {
  const Answer back = answer_of_json(to_json(twins(-1.0)));
  ASSERT_EQ(back.causes[0].confusable_with.size(), 2u);
  EXPECT_EQ(back.causes[0].confusable_with[0].axis, "y");
  EXPECT_EQ(back.causes[0].confusable_with[0].cosine, -1.0);
  std::string old = to_json(answer(Verdict::named, {{"sag", "x", 0}}));
  const auto at = old.find("\"confusable_with\"");
  ASSERT_NE(at, std::string::npos);
  old.replace(at, 17, "\"unknown\"");
  EXPECT_TRUE(answer_of_json(old).causes[0].confusable_with.empty());
}

TEST(BlindTargets, AreDecidedOnlyByTheWholeInterval) {
  const auto standing = [](std::size_t k, std::size_t n, double low, double high) {
    return std::string(text(Target{Goal::in_set, stats::proportion(k, n), low, high}.standing()));
  };
  // Clopper and Pearson at 95 %: 20 of 20 [0.832, 1], 18 of 20 [0.683, 0.988], 2 of 20 [0.012,
  // 0.317].
  EXPECT_EQ(standing(20, 20, 0.80, 1.0), "met");
  EXPECT_EQ(standing(20, 20, 0.98, 1.0), "met, within its interval");
  EXPECT_EQ(standing(18, 20, 0.98, 1.0), "missed, within its interval");
  EXPECT_EQ(standing(18, 20, 0.99, 1.0), "missed");
  EXPECT_EQ(standing(0, 20, 0.0, 0.05), "met, within its interval");
  EXPECT_EQ(standing(2, 20, 0.0, 0.01), "missed");
  EXPECT_EQ(standing(19, 20, 0.91, 0.99), "met, within its interval");
  for (std::size_t n = 0; n < 5; ++n) EXPECT_EQ(standing(0, n, 0.98, 1.0), "not decided") << n;
  EXPECT_EQ(standing(0, 5, 0.98, 1.0), "missed");
}

TEST(BlindTargets, AreReportedWithTheirStanding) {
  const Summary s =
      summarise({score_trial(magnetic, answer(Verdict::named, {{"magnetic_drift", "y", 0}}))});
  const report::Report all = report::blind_report({.title = {}, .summary = s, .scores = {}});
  const std::string report = report::to_text(all);
  EXPECT_NE(report.find("Of 10 targets 0 are met and 0 missed"), std::string::npos) << report;
  EXPECT_NE(report.find("10 not decided."), std::string::npos) << report;
  EXPECT_NE(report.find("1 not decided\n"), std::string::npos) << report;
  EXPECT_NE(report.find("exact, where an identical twin counts as the same cause"),
            std::string::npos)
      << report;
  const std::string& json = all.document.second;
  EXPECT_NE(json.find("\"standing\": \"not decided\""), std::string::npos);
  EXPECT_NE(json.find("\"met\": true"), std::string::npos) << "by the share alone, as ever";
}

}  // namespace
}  // namespace drift::blind::score_test
