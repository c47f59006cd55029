// The command that a short answer ends with is one that the program takes.
#include <gtest/gtest.h>

#include <set>

#include "analysis/inference/candidate.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "core/estimate/layout.hpp"
#include "core/physics/closure.hpp"
#include "mc/study/study.hpp"

namespace drift::next_command_test {
namespace {

/// A study with a term of its own and this filter.
std::string study_text(const std::string& filter) {
  return R"toml(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell  = "10 min"
[[term]]
key = "own"
acts_on = "drift.y"
equation = "B * sin(t / P)"
parameters = { B = { unit = "deg/h", prior = 0.01 }, P = { unit = "min", value = 37 } }
[[filter]]
)toml" + filter +
         "\n[monte_carlo]\nseed = 3\n";
}

/// What is to be done next where an effect is the strongest of what is missing.
std::string next_after(const FilterSpec& nominal, const std::string& label) {
  diagnosis::Diagnosis d;
  d.verdict = diagnosis::Verdict::unexplained;
  d.nominal = nominal;
  d.remarks.emplace_back(diagnosis::remark::StrongestLeft{{label}, "sag.x"});
  return report::diagnosis_in_brief(d).next;
}

/// Its key and value, as a shell hands them over; none where it says none.
mc::Overrides command_in(const std::string& next) {
  const auto at = next.find("--set ");
  if (at == std::string::npos) return {};
  const char quote = next[at + 6];
  const std::string word = next.substr(at + 7, next.rfind(quote) - at - 7);
  const auto equals = word.find('=');
  return {{word.substr(0, equals), word.substr(equals + 1)}};
}

std::vector<std::string> labels_of(const FilterSpec& nominal) {
  Timeline any;
  any.carried = every_known_covariate;
  std::vector<std::string> labels;
  for (const inference::Candidate& c :
       inference::library_candidates(nominal, make_layout(nominal).theta, any).candidates)
    labels.push_back(c.label);
  return labels;
}

class NextCommand : public testing::TestWithParam<const char*> {};

TEST_P(NextCommand, IsTakenWhateverEffectItIsAbout) {
  const std::string text = study_text(GetParam());
  const FilterSpec nominal = mc::read_study_text(text, "study.toml").filters.front();
  std::set<std::string> commands;  // many labels are of one term
  for (const std::string& label : labels_of(nominal)) {
    const std::string next = next_after(nominal, label);
    const mc::Overrides set = command_in(next);
    if (set.empty()) {
      EXPECT_NE(next.find("a prior in [filter.parameters]"), std::string::npos) << next;
      continue;
    }
    if (!commands.insert(next).second) continue;
    mc::Study study;
    ASSERT_NO_THROW(study = mc::read_study_text(text, "study.toml", set)) << next;
    const FilterSpec& with = study.filters.front();
    EXPECT_TRUE(with.coupling != nominal.coupling || (with.active & ~nominal.active).any()) << next;
    EXPECT_TRUE((nominal.active & ~with.active).none()) << next;
  }
  EXPECT_GT(commands.size(), 40u);
}

INSTANTIATE_TEST_SUITE_P(
    Filters, NextCommand,
    testing::Values("name = 'nominal'\ncoupling = 'eq5'",
                    "name = 'nominal'\ncoupling = 'eq6'\nterms = ['fixed_drift', 'g_drift.x']",
                    "name = 'lambda'\ncoupling = 'lambda'",
                    "name = 'lambda'\ncoupling = 'lambda'\nterms = ['fixed_drift']\n"
                    "parameters = { lambda = 0.5 }",
                    "name = 'eq. (5)'\ncoupling = 'eq5'\nterms = ['accelerometer']\n"
                    "parameters = { K2 = '12 ug/g^2' }",
                    "name = 'loop'\ncoupling = 'compensated'"));

TEST(NextCommand, OfAnotherDriftEquationIsTheOtherOne) {
  FilterSpec nominal;
  nominal.name = "nominal";
  nominal.coupling = Coupling::eq6;
  EXPECT_EQ(next_after(nominal, "frame_closure"),
            "Next: more than one effect, or one of another shape, seems to be missing. Diagnose "
            "again under the other equation: --set \"filter.nominal.coupling=eq5\".");
  EXPECT_NE(report::in_words(diagnosis::remark::StrongestLeft{{"frame_closure"}, "sag.x"})
                .find("take the other equation and diagnose again"),
            std::string::npos);
}

}  // namespace
}  // namespace drift::next_command_test
