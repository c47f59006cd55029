// What proposed positions bring, in the report of `rank`.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/report/rank/sections.hpp"
#include "tests/analysis/report/figures_of.hpp"

namespace drift::rank_improvement_test {
namespace {

TEST(RankImprovement, SaysOfOneParameterThatItGainsLess) {
  // Without accelerometers nothing shows K0_x; a further position shows more of each drift.
  const mc::Study study = mc::read_study_text(R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
dwell  = "10 min"
sample = "5 min"
mode   = "level"
[[plan.position]]
axes = "x=N y=W z=U"
[readout]
accelerometers = false
[[filter]]
name = "f"
coupling = "eq5"
terms = ["D_F", "K0_x"]
)",
                                              "s.toml");
  const planning::PlanRanking rank = planning::rank_plan(study, {.improve = 1, .threads = 1});
  const auto figures = test::figures_of({report::improvement(study, rank)});
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_NE(figures[0].caption.find(" 1 parameter gains less, or nothing: it is in the table."),
            std::string::npos)
      << figures[0].caption;
}

/// A study, ranked with one more position, and what is said of it.
struct Improved {
  mc::Study study;
  planning::PlanRanking rank;

  explicit Improved(const std::string& plan, const std::string& more = "",
                    const mc::Overrides& set = {})
      : study(mc::read_study_text(R"(schema = 1
[site]
latitude = "45.75 deg"
)" + plan + R"([[filter]]
name = "f"
coupling = "eq5"
terms = ["D_F", "D_I"]
)" + more,
                                  "s.toml", set)),
        rank(planning::rank_plan(study, {.improve = 1, .threads = 1})) {}

  /// A file beside the report; empty of none.
  std::string file(std::string_view name) const {
    const report::Report report = report::rank_report(study, rank, "out");
    const auto found = std::ranges::find(report.files, name, &TextFile::first);
    return found == report.files.end() ? "" : found->second;
  }
};

/// Keys behind that of the preset, where [[plan.position]] has no place.
constexpr const char* preset = R"([plan]
preset = "six"
dwell  = "10 min"
sample = "5 min"
mode   = "level"
entry  = "caged"
)";
constexpr const char* listed = R"([plan]
dwell  = "10 min"
sample = "5 min"
mode   = "level"
[[plan.position]]
name = "mine"
axes = "x=N y=W z=U"
)";

/// That improved.toml is read, and that its plan is the old one and the positions proposed.
void expect_improved(const Improved& a) {
  ASSERT_FALSE(a.rank.better->improvement.steps.empty());
  const mc::Study again =
      mc::read_study_text(a.file(report::improved_study), report::improved_study);
  const std::vector<Position>& meant = a.rank.better->improvement.plan.positions;
  ASSERT_EQ(meant.size(), a.study.plan.positions.size() + 1);
  ASSERT_EQ(again.plan.positions.size(), meant.size());
  for (std::size_t k = 0; k < meant.size(); ++k) {
    const Position &is = again.plan.positions[k],
                   &was = k + 1 < meant.size() ? a.study.plan.positions[k]
                                               : a.rank.better->improvement.steps.front().position;
    EXPECT_EQ(is.name, was.name);
    EXPECT_LT((is.R_lp - was.R_lp).norm(), 1e-14) << was.name;
    EXPECT_DOUBLE_EQ(is.dwell, was.dwell);
    EXPECT_DOUBLE_EQ(is.sample, was.sample);
    EXPECT_EQ(is.mode, was.mode);
    EXPECT_EQ(is.entry, was.entry);
  }
  EXPECT_NO_THROW(planning::rank_plan(again, {.threads = 1}));
}

TEST(RankImprovement, IsAStudyOfThePlanWithThePositionsProposed) {
  expect_improved(Improved(preset));
  expect_improved(Improved(listed));
}

TEST(RankImprovement, IsTheStudyThatWasRanked) {
  const Improved a(preset, "", {{"plan.dwell", "20 min"}, {"site.latitude", "48 deg"}});
  expect_improved(a);
  const mc::Study again = mc::read_study_text(a.file(report::improved_study), "improved.toml");
  EXPECT_DOUBLE_EQ(again.plan.positions.front().dwell, 1200.0);
  EXPECT_DOUBLE_EQ(again.site.latitude, a.study.site.latitude);
}

TEST(RankImprovement, NamesTheStudyWhereItIsWritten) {
  const Improved a(preset);
  EXPECT_NE(report::rank_in_brief(a.study, a.rank, "my results")
                .next.find("Next: go on with 'my results/improved.toml', the study with this "),
            std::string::npos);
  const std::string nowhere = report::rank_in_brief(a.study, a.rank).next;
  EXPECT_NE(nowhere.find("Next: the same command with -o DIR writes it as a study"),
            std::string::npos)
      << nowhere;
  EXPECT_EQ(nowhere.find(".toml"), std::string::npos) << nowhere;
}

TEST(RankImprovement, SaysWhatItsStudyDoesNotSweep) {
  const Improved a(preset, R"([sweep]
"plan.preset" = ["six", "twelve"]
"readout.gimbal_noise" = ["5 arcsec", "10 arcsec"]
)");
  expect_improved(a);
  const std::string said = "improved.toml does not sweep plan.preset: ";
  EXPECT_EQ(a.file(report::improved_study).find("# " + said), 0u);
  const auto noted = [&](const std::string& folder) {
    const auto more = report::rank_in_brief(a.study, a.rank, folder).more.texts();
    return std::ranges::any_of(more, [&](const std::string& t) { return t.find(said) == 0; });
  };
  EXPECT_TRUE(noted("out"));
  EXPECT_FALSE(noted("")) << "no such file is written";
}

TEST(RankImprovement, OfNoPositionsIsNoStudy) {
  const Improved a(listed);
  const planning::PlanRanking plain = planning::rank_plan(a.study, {.threads = 1});
  std::vector<std::string> names;
  for (const TextFile& file : report::rank_report(a.study, plain, "out").files)
    names.push_back(file.first);
  EXPECT_EQ(names, (std::vector<std::string>{"ranking.csv", "study.toml"}));
}

TEST(RankImprovement, OfAPresetHasItsPlaceBehindTheOtherKeysOfThePlan) {
  const std::string positions = Improved(preset).file("proposed_positions.toml");
  EXPECT_EQ(positions.find("# All of the plan, behind the other keys of [plan]. Remove preset = "
                           "\"six\" there:\n[[plan.position]]"),
            0u)
      << positions;
  std::string plan = preset;
  const std::string key = "preset = \"six\"\n";
  plan.erase(plan.find(key), key.size());
  EXPECT_EQ(Improved(plan + positions).study.plan.positions.size(), 7u);
}

}  // namespace
}  // namespace drift::rank_improvement_test
