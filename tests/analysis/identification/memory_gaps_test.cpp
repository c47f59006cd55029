// When, in a gap of a recording, the platform was turned: said where a size hangs on it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/identify/sections.hpp"
#include "analysis/report/page/wording.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::memory_gaps_test {
namespace {

using namespace drift::test;

/// Six caged positions of 20 minutes, five minutes that nobody recorded in front of each but the
/// first, and a filter that knows the fluid's time constant.
struct Scene {
  mc::Study study = six_study();
  Recording recording;

  explicit Scene(double tau, double gap = 300.0) {
    study.truth.active = only({"D_F"});
    FilterSpec& filter = study.filters.front();
    filter.active = TermLibrary::completed(only({"D_F", "R"}));
    filter.priors[param("R_tau")] = fixed(tau);
    recording = simulated(study);
    const std::vector<double>& position = channel(recording, "position");
    std::vector<double>& time = channel(recording, "time");
    for (std::size_t k = 0; k < time.size(); ++k) time[k] += gap * (position[k] - 1.0);
  }
  identification::Identification identified() const {
    return identification::identify_recordings(study, {recording}, 1);
  }
};

TEST(MemoryGaps, AreToldWithTheirPlaceTheirLengthAndTheFactor) {
  const Scene s(600.0);
  const auto id = s.identified();
  const auto& gaps = id.runs.front().memory_gaps;
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps.front().count, 5u);
  EXPECT_EQ(gaps.front().widest.term, "reposition_transient");
  EXPECT_NEAR(gaps.front().widest.length, 300.0, 1e-6);
  EXPECT_NEAR(gaps.front().widest.left, std::exp(-0.5), 1e-9);
  const report::FilterView view{s.study, id, id.summaries.front()};
  const std::string said = report::remembered_text(view);
  EXPECT_NE(said.find("Filter filter: between positions"), std::string::npos) << said;
  EXPECT_NE(said.find("(and before 4 more), 5 min are not recorded"), std::string::npos) << said;
  EXPECT_NE(said.find("reposition_transient would be 1.65 times smaller"), std::string::npos)
      << said;
  EXPECT_EQ(report::identification_in_brief(s.study, id).tone, report::Tone::doubtful);
}

TEST(MemoryGaps, BeginAtATenthOfWhatIsLeft) {
  // 1 - exp(-gap / tau) is 0.1 at tau = 9.49 gaps.
  EXPECT_FALSE(Scene(9.4 * 300.0).identified().runs.front().memory_gaps.empty());
  EXPECT_TRUE(Scene(9.6 * 300.0).identified().runs.front().memory_gaps.empty());
  EXPECT_TRUE(Scene(600.0, 0.0).identified().runs.front().memory_gaps.empty());
}

TEST(MemoryGaps, AreToldByADiagnosisToo) {
  const Scene s(600.0);
  diagnosis::DiagnoseOptions options;
  options.starts = 1;
  options.whiteness_draws = 0;
  const diagnosis::Diagnosis d = diagnosis::diagnose(s.study, {s.recording}, options);
  const auto* off = diagnosis::remark_in<diagnosis::remark::MemoryOff>(d);
  ASSERT_NE(off, nullptr);
  EXPECT_TRUE(off->terms.empty());
  EXPECT_EQ(off->gaps.size(), 1u);
  const char* said = "that the platform was turned at their beginning is assumed";
  EXPECT_NE(nlohmann::json::parse(report::to_json(d))["remarks"].dump().find(said),
            std::string::npos);
  std::string all;
  for (const std::string& text : report::diagnosis_in_brief(d).more.texts()) all += text;
  EXPECT_NE(all.find(said), std::string::npos) << all;
}

TEST(MemoryGaps, OfHoursGiveNoFactor) {
  const std::string said =
      report::memory_sentences({}, {{{"reposition_transient", 2, 3, 36000.0, 1e-20}, 1}});
  EXPECT_NE(said.find("Between positions 3 and 4, 600 min are not recorded"), std::string::npos)
      << said;
  EXPECT_NE(said.find("would be more than 100 times smaller"), std::string::npos) << said;
  EXPECT_TRUE(report::memory_sentences({}, {}).empty());
}

}  // namespace
}  // namespace drift::memory_gaps_test
