// A recording that states a compensating loop, and filters that do not know of it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/identification/stated_loop.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/words.hpp"
#include "analysis/report/identify/loop_words.hpp"
#include "analysis/report/identify/sections.hpp"
#include "core/recording/recording_channels.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::loop_left_out_test {
namespace {

using namespace drift::test;

/// Six positions in a loop that removed 40 arcsec of eta_x, or nothing, and a filter of eq. (5).
struct Scene {
  mc::Study study = six_study();
  Recording recording;

  explicit Scene(double eta_x = 40.0 * arcsec) {
    study.truth.coupling = Coupling::compensated;
    study.truth.theta_loop[param("eta_x")] = eta_x;
    Timeline timeline = lay_out(study.plan, study.site);
    set_loop(timeline, study.truth);
    recording =
        make_recording(timeline, Simulator(study.truth, study.readout).run(timeline, 1, 0).measured,
                       study.readout);
  }
  identification::Identification identified() const {
    return identification::identify_recordings(study, {recording}, 1);
  }
  diagnosis::Diagnosis diagnosed() const {
    diagnosis::RecordingsOptions options;
    options.diagnose.starts = 1;
    options.diagnose.whiteness_draws = 0;
    options.advising = diagnosis::Advising::left_out;
    return diagnosis::diagnose_recordings(study, {recording}, options);
  }
};

std::string all_of(const report::InBrief& brief) {
  std::string all;
  for (const std::string& text : brief.more.texts()) all += text + "\n";
  return all;
}

constexpr const char* said =
    "Loop: The recording states that a loop removed misalignments of the gyros (loop_eta_x to "
    "loop_xi_z), and filter filter leaves that out";

TEST(LoopLeftOut, IsStatedByColumnsThatAreNotZero) {
  const Scene acting, idle(0.0);
  const auto of_one = identification::stated_loop({acting.recording});
  ASSERT_TRUE(of_one);
  EXPECT_EQ(of_one->recordings, std::vector<std::size_t>{1});
  EXPECT_TRUE(of_one->whole);
  EXPECT_FALSE(identification::stated_loop({idle.recording}));
  Recording without = acting.recording;
  std::erase_if(without.channels, [](const Channel& c) { return c.name.starts_with("loop_"); });
  EXPECT_FALSE(identification::stated_loop({without}));
  const auto of_second = identification::stated_loop({without, acting.recording});
  ASSERT_TRUE(of_second);
  EXPECT_EQ(of_second->recordings, std::vector<std::size_t>{2});
  EXPECT_FALSE(of_second->whole);
}

TEST(LoopLeftOut, IsSaidByIdentifyWithWhatToSet) {
  Scene s;
  const auto id = s.identified();
  const report::InBrief brief = report::identification_in_brief(s.study, id);
  EXPECT_NE(all_of(brief).find(said), std::string::npos) << all_of(brief);
  EXPECT_NE(brief.tone, report::Tone::good);
  EXPECT_EQ(brief.next,
            "Next: identify again with the loop in the filter: --set "
            "filter.filter.coupling=compensated.");
  const auto json = report::identification_document(s.study, id)["filters"][0]["loop_left_out"];
  EXPECT_EQ(json.dump(), "[1]");

  s.study.filters.front().coupling = Coupling::compensated;
  const auto knows = s.identified();
  EXPECT_EQ(all_of(report::identification_in_brief(s.study, knows)).find("Loop: "),
            std::string::npos);
  EXPECT_EQ(report::identification_document(s.study, knows)["filters"][0]["loop_left_out"].dump(),
            "[]");
}

TEST(LoopLeftOut, BesideAFilterThatKnowsOfItIsANote) {
  Scene s;
  auto id = s.identified();
  FilterSpec knows = s.study.filters.front();
  knows.name = "knows";
  knows.coupling = Coupling::compensated;
  s.study.filters.push_back(knows);
  const report::InBrief brief = report::identification_in_brief(s.study, id);
  EXPECT_NE(all_of(brief).find(said), std::string::npos) << all_of(brief);
  EXPECT_EQ(brief.more.first_wrong().find("Loop"), std::string::npos);
  EXPECT_EQ(brief.next.find("coupling=compensated"), std::string::npos) << brief.next;
}

TEST(LoopLeftOut, LeadsTheDoubtsOfADiagnosis) {
  Scene s;
  const diagnosis::Diagnosis d = s.diagnosed();
  const report::InBrief brief = report::diagnosis_in_brief(d);
  EXPECT_EQ(brief.more.first_wrong().find(said), 0u) << all_of(brief);
  EXPECT_EQ(brief.next,
            "Next: diagnose again with the loop in the filter: --set "
            "filter.filter.coupling=compensated.");
  EXPECT_NE(brief.tone, report::Tone::good);
  EXPECT_NE(report::remarks_of(d).front().find("removed misalignments"), std::string::npos);
  const auto json = nlohmann::json::parse(report::to_json(d));
  EXPECT_EQ(json["loop_left_out"].dump(), "[1]");

  s.study.filters.front().coupling = Coupling::compensated;
  const diagnosis::Diagnosis knows = s.diagnosed();
  EXPECT_EQ(diagnosis::remark_in<diagnosis::remark::LoopLeftOut>(knows), nullptr);
  EXPECT_EQ(nlohmann::json::parse(report::to_json(knows))["loop_left_out"].dump(), "[]");
}

TEST(LoopLeftOut, OfSeveralRecordingsNamesThoseThatStateOne) {
  const identification::StatedLoop loop{{2}, false};
  const std::string text = report::loop_left_out_text(loop, {"a.csv", "b.csv"}, {"eq5", "eq6"});
  EXPECT_EQ(text.find("b.csv states that a loop removed"), 0u) << text;
  EXPECT_NE(text.find("filters eq5 and eq6 leave that out"), std::string::npos) << text;
  FilterSpec filter;
  filter.name = "my filter";
  EXPECT_EQ(report::loop_next(loop, filter, 1, "identify"),
            "Next: give every recording the columns loop_eta_x to loop_xi_z, 0 where no loop "
            "removed anything, and identify again with the loop in the filter: --set "
            "filter.1.coupling=compensated.");
}

}  // namespace
}  // namespace drift::loop_left_out_test
