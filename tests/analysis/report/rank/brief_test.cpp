// The short answer of `rank`.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/report/rank/sections.hpp"
#include "tests/support/two_cagings.hpp"

namespace drift::rank_brief_test {
namespace {

using namespace report;

struct Answer {
  mc::Study study;
  planning::PlanRanking rank;
  InBrief brief;

  explicit Answer(const std::string& text, const planning::RankOptions& options = {.threads = 1})
      : study(mc::read_study_text(text, "s.toml")),
        rank(planning::rank_plan(study, options)),
        brief(rank_in_brief(study, rank)) {}
};

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

/// Where a sentence stands among those behind the verdict, from 0; npos where none has it.
std::size_t place_of(const InBrief& brief, std::string_view part) {
  const std::vector<std::string> all = brief.more.texts();
  const auto at = std::ranges::find_if(all, [&](const auto& text) { return has(text, part); });
  return at == all.end() ? std::string::npos : static_cast<std::size_t>(at - all.begin());
}

TEST(RankBrief, SaysForWhichFilterAndEquationAPlanIsBetter) {
  const Answer a(R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
dwell  = "10 min"
sample = "2 min"
mode   = "level"
[[plan.position]]
axes  = "x=N y=W z=U"
[[filter]]
name = "corrected"
coupling = "eq6"
terms = ["fixed_drift"]
[[filter]]
name = "legacy"
coupling = "eq5"
terms = ["fixed_drift"]
)",
                 {.improve = 1, .criterion = "D_F_z", .threads = 1});
  EXPECT_TRUE(has(a.brief.verdict, "Seen under eq6 (filter corrected): ")) << a.brief.verdict;
  const std::string better = a.brief.more.texts().front();
  EXPECT_TRUE(has(better, "under eq6 (filter corrected)")) << better;
}

/// Eighteen positions, at 45 deg too, and gyros with all terms of g^2: the sum of their squares is
/// constant in any laboratory (physics.md 2.4).
std::string with_squares(const std::string& parameters = "") {
  return R"(schema = 1
[site]
latitude = "-35 deg"
[plan]
preset = "eighteen"
dwell  = "10 min"
sample = "5 min"
mode   = "level"
[[filter]]
name = "f"
coupling = "eq5"
terms = ["fixed_drift", "g_drift", "g2_drift"]
)" + parameters;
}

TEST(RankBrief, NamesWhatNoPositionShowsAndProposesNoneForIt) {
  // Each parameter alone is seen: 0.58 of the prior sigmas of squares, 1/sqrt(3), are left.
  const Answer a(with_squares());
  for (const auto& p : a.rank.groups.front().models.front().ranking.parameters)
    ASSERT_LT(p.learning_ratio(), 0.9);
  EXPECT_TRUE(has(a.brief.verdict, "3 combinations are not seen, and no position shows them."))
      << a.brief.verdict;
  const std::string list = a.brief.more.texts().back();
  EXPECT_TRUE(list.starts_with("Not seen under eq5 (filter f): D_F_x - D_II_x - D_OO_x - D_SS_x, "))
      << list;
  EXPECT_TRUE(has(list, "= 1 g^2 in any laboratory")) << list;
  EXPECT_FALSE(has(a.brief.verdict, "every one is seen"));
  EXPECT_EQ(a.brief.tone, Tone::doubtful);
  EXPECT_EQ(a.brief.next,
            "Next: of a combination that no position shows, fix one parameter or declare its "
            "prior.");
}

TEST(RankBrief, SaysTheCombinationsOfTwoFiltersOnce) {
  const Answer a(
      with_squares("[[filter]]\nname = \"other\"\ncoupling = \"eq6\"\n"
                   "terms = [\"fixed_drift\", \"g_drift\", \"g2_drift\"]\n"));
  const std::vector<std::string> more = a.brief.more.texts();
  ASSERT_EQ(more.size(), 2u);
  EXPECT_TRUE(has(more[0], "; the same combinations are not seen.")) << more[0];
  EXPECT_TRUE(has(more[1], "D_F_x - D_II_x - D_OO_x - D_SS_x")) << more[1];
}

TEST(RankBrief, ProposesNoPositionsForAParameterThatACombinationHides) {
  // 0.01 deg/h against 0.1 deg/h/g^2 of each square: of D_F_x 100 / sqrt(100^2 + 3 * 10^2) = 0.985
  // of the prior sigma is left whatever the plan.
  const Answer a(
      with_squares("[filter.parameters]\nD_F = { normal = [\"0 deg/h\", \"0.01 deg/h\"] }\n"));
  EXPECT_TRUE(has(a.brief.verdict, "hardly or not seen")) << a.brief.verdict;
  EXPECT_FALSE(has(a.brief.next, "--improve")) << a.brief.next;
  EXPECT_TRUE(has(a.brief.next, "fix one parameter")) << a.brief.next;
}

TEST(RankBrief, ProposesPositionsForACombinationThatTheyShow) {
  // At cardinal positions a_I^3 = a_I: K1 with K3 is not seen, 45 deg show it.
  const std::string filter = "[[filter]]\nname = \"f\"\ncoupling = \"eq5\"\nterms = ";
  const std::string plan = R"(schema = 1
[site]
latitude = "45 deg"
[plan]
preset = "twentyfour"
dwell  = "10 min"
sample = "5 min"
mode   = "level"
)";
  const Answer a(plan + filter + "[\"K0\", \"K1\", \"K3\"]\n");
  EXPECT_TRUE(has(a.brief.verdict, "3 combinations are not seen.")) << a.brief.verdict;
  EXPECT_NE(place_of(a.brief, "K1_x - K3_x, "), std::string::npos);
  EXPECT_TRUE(has(a.brief.next, "driftscope rank s.toml --improve 3 -o out/rank proposes"))
      << a.brief.next;
  EXPECT_TRUE(has(rank_in_brief(a.study, a.rank, "my results").next,
                  "--improve 3 -o 'my results' proposes"));
  EXPECT_FALSE(has(a.brief.next, "fix one parameter")) << a.brief.next;
  // Without K3 all is seen.
  const Answer whole(plan + filter + "[\"K0\", \"K1\"]\n");
  EXPECT_TRUE(has(whole.brief.verdict, "every one is seen")) << whole.brief.verdict;
  EXPECT_EQ(whole.brief.tone, Tone::good);
  EXPECT_EQ(whole.brief.next, "");
}

TEST(RankBrief, WhatWasAskedForAndWhatLimitsItStandBeforeLists) {
  // The priors of three squares hold D_F_x to 0.1 deg/h / sqrt(3) whatever the plan.
  const Answer a(with_squares("drift_random_walk = \"0.001 deg/h/sqrt(h)\"\n"),
                 {.improve = 1, .criterion = "D_F_x", .threads = 1});
  const std::size_t asked = place_of(a.brief, "No better plan was found for D_F_x"),
                    noise = place_of(a.brief, "A drift that walks"),
                    list = place_of(a.brief, "Not seen under");
  ASSERT_NE(list, std::string::npos);
  EXPECT_EQ(asked, 0u);
  EXPECT_EQ(noise, 1u);
  EXPECT_LT(noise, list);
  EXPECT_TRUE(has(a.brief.more.texts()[asked], "None that the gimbals allow makes it smaller."))
      << "it is seen: " << a.brief.more.texts()[asked];
  const std::string said = brief_text(a.brief);
  EXPECT_TRUE(has(said, "No better plan was found for D_F_x")) << said;
  EXPECT_EQ(a.brief.more.texts()[noise],
            "A drift that walks is that of the last sample, as the filter reports it: D_F_x, D_F_y "
            "and D_F_z of f.");
  EXPECT_TRUE(has(said, "A drift that walks is that of the last sample")) << said;
  const std::string whole = whole_text(a.brief, 1000);
  for (const std::string& text : a.brief.more.texts()) EXPECT_TRUE(has(whole, text)) << text;
}

TEST(RankBrief, SaysWhereTruthsAreDrawnFrom) {
  // eta_x is seen by D_I_z times it: not at D_I_z = 0, where the plan is linearised.
  const std::string terms = "terms = [\"D_F\", \"D_I_z\", \"eta_x\"]\n";
  const std::string study = test::two_cagings + std::string(R"([[filter]]
name = "f"
coupling = "eq6"
)") + terms;
  const Answer priors(study), truth(study + "[truth]\ncoupling = \"eq6\"\n" + terms);
  EXPECT_TRUE(has(priors.brief.verdict, "at truths drawn from the priors (what"))
      << priors.brief.verdict;
  EXPECT_TRUE(has(truth.brief.verdict, "at truths drawn from [truth] (what"))
      << truth.brief.verdict;
}

TEST(RankBrief, APromiseThatHangsOnTheTruthIsNotMadeWithoutThat) {
  // D_F_z comes to 0.0003 deg/h where the plan is linearised, to four times that and more
  // elsewhere.
  const Answer a(test::two_cagings + std::string(R"([[filter]]
name = "f"
coupling = "eq6"
terms = ["D_F", "D_I", "eta"]
)"),
                 {.improve = 1, .criterion = "D_F_z", .threads = 1});
  const std::size_t k = a.rank.better->improvement.criterion.state;
  ASSERT_GT(a.rank.better->elsewhere[k].low, 2.0 * a.rank.better->after.learning_ratio(k));
  const std::string said = a.brief.more.texts().front();
  EXPECT_TRUE(has(said, " at four truths drawn from the priors).")) << said;
  EXPECT_TRUE(has(brief_text(a.brief, 400), said)) << brief_text(a.brief, 400);
}

}  // namespace
}  // namespace drift::rank_brief_test
