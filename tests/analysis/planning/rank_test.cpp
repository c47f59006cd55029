// What of a study is ranked, and for whom positions are proposed.
#include "analysis/planning/rank.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/two_cagings.hpp"

namespace drift::rank_test {
namespace {

constexpr const char* torqued_twice = R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
dwell  = "10 min"
sample = "2 min"
mode   = "free"
entry  = "torqued"
[[plan.position]]
axes  = "x=N y=W z=U"
entry = "caged"
[[plan.position]]
axes = "x=N y=U z=E"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment"]
[truth.parameters]
D_F = "1 deg/h"
)";

std::string filter(const std::string& name, const std::string& coupling) {
  return "[[filter]]\nname = \"" + name + "\"\ncoupling = \"" + coupling +
         "\"\nterms = [\"fixed_drift\", \"gyro_misalignment\"]\n";
}

TEST(RankPlan, ChoosesPositionsForTheFirstFilterWhicheverItsEquation) {
  for (const Coupling first : {Coupling::eq5, Coupling::eq6}) {
    const bool swapped = first == Coupling::eq6;
    const mc::Study study =
        mc::read_study_text(torqued_twice + filter("one", swapped ? "eq6" : "eq5") +
                                filter("other", swapped ? "eq5" : "eq6"),
                            "s.toml");
    const planning::PlanRanking rank = planning::rank_plan(
        study, {.improve = 1, .criterion = "eta_x", .threads = 1, .bins_per_dwell = 1});
    ASSERT_EQ(rank.groups.size(), 1u);
    const planning::ModelRanking& m = rank.groups.front().models.front();
    EXPECT_EQ(m.model.spec.coupling, first);
    EXPECT_EQ(m.filters, "one");
    const planning::Improvement& better = rank.better->improvement;
    ASSERT_EQ(better.steps.size(), 1u);
    // The criterion is the learning ratio of eta_x by the information of the same model: rounding.
    const double ratio = m.ranking.learning_ratio(better.criterion.state);
    EXPECT_NEAR(better.steps.front().before, ratio, 1e-9 * ratio);
    // Under the other equation eta_x is another sigma, or the two could not be told apart here.
    const double other =
        rank.groups.front().models[1].ranking.learning_ratio(better.criterion.state);
    EXPECT_GT(std::abs(other - ratio), 1e-3 * ratio);
  }
}

/// Two cagings in free drift.
std::string caged_twice(const std::string& coupling, const std::string& truth) {
  return test::two_cagings + std::string(R"([truth]
terms = ["D_F", "D_I_z", "eta_x", "xi_y"]
)") + truth +
         "[[filter]]\nname = \"f\"\ncoupling = \"" + coupling +
         "\"\nterms = [\"D_F\", \"D_I_z\", \"eta_x\", \"xi_y\"]\n";
}

planning::ModelRanking ranked(const std::string& study) {
  return planning::rank_plan(mc::read_study_text(study, "s.toml"),
                             {.threads = 1, .bins_per_dwell = 1})
      .groups.front()
      .models.front();
}

TEST(RankPlan, DrawsTruthsFromWhatTheTruthLeavesOpenAlone) {
  // What shows eta_x is D_I_z times it. Where D_I_z is a number, what is left of eta_x (prior sigma
  // 200 arcsec, 1e-3) is the same at every truth to some 1e-3.
  const auto fixed_drift = ranked(caged_twice("eq6",
                                              "coupling = \"eq6\"\n[truth.parameters]\n"
                                              "D_I_z = \"2 deg/h/g\"\nD_F = \"0 deg/h\"\n"));
  for (std::size_t k = 0; k < fixed_drift.elsewhere.size(); ++k) {
    const double here = fixed_drift.ranking.learning_ratio(k);
    EXPECT_NEAR(fixed_drift.elsewhere[k].low, here, 0.02 * here);
    EXPECT_NEAR(fixed_drift.elsewhere[k].high, here, 0.02 * here);
    EXPECT_TRUE(fixed_drift.elsewhere[k].drawn());
  }
  const auto open_drift = ranked(caged_twice("eq6", "coupling = \"eq6\"\n"));
  const Layout& layout = open_drift.ranking.layout;
  const auto eta_x = static_cast<std::size_t>(
      std::ranges::find(layout.params, TermLibrary::index("eta_x")) - layout.params.begin());
  ASSERT_LT(eta_x, layout.size());
  EXPECT_TRUE(open_drift.elsewhere[eta_x].other_than(open_drift.ranking.learning_ratio(eta_x)));
}

TEST(RankPlan, FiltersOfOtherProcessNoiseAreRankedByThemselves) {
  // D_F of the one that walks is that of the last sample, and less known.
  const mc::Study study = mc::read_study_text(
      torqued_twice + filter("still", "eq5") + filter("walking", "eq6") +
          "drift_random_walk = \"0.01 deg/h/sqrt(h)\"\n" + filter("other", "eq6"),
      "s.toml");
  const planning::PlanRanking rank =
      planning::rank_plan(study, {.threads = 1, .bins_per_dwell = 1});
  ASSERT_EQ(rank.groups.size(), 2u);
  EXPECT_EQ(rank.groups[0].filters, "still, other");
  EXPECT_EQ(rank.groups[1].filters, "walking");
  EXPECT_TRUE(rank.process_noise);
  const observability::Ranking &still = rank.groups[0].models[1].ranking,
                               &walking = rank.groups[1].models[0].ranking;
  EXPECT_TRUE(still.walking.empty());
  ASSERT_EQ(walking.walking.size(), 3u);
  for (const std::size_t k : walking.walking)
    EXPECT_GT(walking.learning_ratio(k), 1.1 * still.learning_ratio(k));
  for (std::size_t k = 0; k < walking.parameters.size(); ++k)
    EXPECT_GT(walking.learning_ratio(k), (1.0 - 1e-9) * still.learning_ratio(k));
}

TEST(RankPlan, KnowsNoOtherTruthWhereTheTruthIsNumbersAndAnEquation) {
  const std::string numbers =
      "coupling = \"eq5\"\n[truth.parameters]\nD_F = \"1 deg/h\"\nD_I_z = \"2 deg/h/g\"\n"
      "eta_x = \"100 arcsec\"\nxi_y = \"-50 arcsec\"\n";
  for (const char* coupling : {"eq5", "lambda"}) {
    const planning::ModelRanking m = ranked(caged_twice(coupling, numbers));
    for (std::size_t k = 0; k < m.elsewhere.size(); ++k) {
      EXPECT_FALSE(m.elsewhere[k].drawn());
      EXPECT_FALSE(m.elsewhere[k].other_than(m.ranking.learning_ratio(k)));
    }
  }
}

}  // namespace
}  // namespace drift::rank_test
