// What the short answer of a blind study says of its targets: all of them, the missed ones first.
#include "analysis/report/blind/target_words.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/report/blind/report.hpp"

namespace drift::target_words_test {
namespace {

using blind::Goal;
using stats::proportion;

/// The targets of a study with what was measured of each.
blind::Summary summary_of(std::size_t trials, const std::vector<stats::Proportion>& measured) {
  blind::Summary s = blind::summarise({});
  s.trials = trials;
  for (std::size_t k = 0; k < measured.size(); ++k) s.targets[k].measured = measured[k];
  return s;
}

/// Of configs/blind_small.toml.
blind::Summary twenty_trials() {
  return summary_of(20, {proportion(3, 13), proportion(0, 4), proportion(0, 3), proportion(4, 4),
                         proportion(8, 8), proportion(4, 8), proportion(0, 8), proportion(0, 2),
                         proportion(0, 2), proportion(4, 4)});
}

report::InBrief brief_of(const blind::Summary& s) {
  return report::blind_report({.title = {}, .summary = s, .scores = {}}).brief;
}

TEST(BlindBrief, HasAllTargetsTheMissedFirstWithinTheLines) {
  const report::InBrief brief = brief_of(twenty_trials());
  EXPECT_EQ(brief.verdict,
            "1 of 10 targets missed, 1 missed within its interval, 6 not decided: 20 trials.");
  const std::vector<std::string> texts = brief.more.texts();
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_EQ(texts[0],
            "Missed: nominal fit looks healthy 3 of 13 (at least 0.80); within its interval: one "
            "right name 4 of 8 (at least 0.75).");
  EXPECT_TRUE(
      texts[1].starts_with("Not decided: two effects found 0 of 2 (at least 0.90); unknown "
                           "effect unexplained 0 of 2 (at least 0.80); size within 2 sigma "
                           "4 of 4 (0.91 to 0.99); alarms, nothing hidden 0 of 4"))
      << "first what is missed by its share: " << texts[1];
  EXPECT_EQ(texts[2],
            "Met, within its interval: in a set of up to three 8 of 8 (at least 0.95); one wrong "
            "name 0 of 8 (at most 0.01).");
  EXPECT_EQ(brief.tone, report::Tone::bad);
  const std::string said = report::brief_text(brief);
  EXPECT_EQ(said.find("--full"), std::string::npos) << "all have room: " << said;
  EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 10) << said;
}

TEST(BlindBrief, OfAThousandTrialsAllHaveRoomToo) {
  const report::InBrief brief = brief_of(summary_of(
      1000, {proportion(573, 679), proportion(1, 183), proportion(5, 138), proportion(171, 171),
             proportion(244, 256), proportion(166, 256), proportion(0, 256), proportion(52, 64),
             proportion(36, 46), proportion(318, 344)}));
  EXPECT_EQ(brief.verdict, "2 of 10 targets missed, 1 missed within its interval: 1000 trials.");
  EXPECT_EQ(brief.next, "");
  const std::string said = report::brief_text(brief);
  EXPECT_EQ(said.find("--full"), std::string::npos) << said;
  EXPECT_EQ(said.find("..."), std::string::npos) << said;
}

TEST(BlindBrief, WhatIsMetOrLacksAnAnswerIsSaid) {
  blind::Summary s = twenty_trials();
  for (blind::Target& t : s.targets) {
    const bool few = t.high < 1.0 && t.low == 0.0;
    t.measured = proportion(few ? 0 : t.goal == Goal::size_within_two_sigma ? 9500 : 10000, 10000);
  }
  EXPECT_EQ(brief_of(s).verdict, "All 10 targets met: 20 trials.");
  EXPECT_EQ(brief_of(s).tone, report::Tone::good);
  s.targets.front().measured = proportion(4, 5);
  EXPECT_EQ(brief_of(s).verdict, "All 10 targets met, 1 within its interval: 20 trials.");
  s.targets.front().measured = proportion(10000, 10000);
  s.failed = 2;
  EXPECT_EQ(brief_of(s).verdict, "All 10 targets met: 20 trials, 2 of them without an answer.");
  s.targets.front().measured = {};
  EXPECT_TRUE(brief_of(s).more.texts().front().starts_with(
      "Not decided: nominal fit looks healthy, no trial (at least 0.80)."))
      << brief_of(s).more.texts().front();
}

/// tests/reference and whoever follows studies go by these.
TEST(BlindBrief, TheNamesOfBlindJsonStay) {
  const report::Report all =
      report::blind_report({.title = {}, .summary = twenty_trials(), .scores = {}});
  for (const char* name : {"power at 8 sigma", "false alarms on wrong-noise nulls",
                           "8 sigma and above: exact single name", "pairs found as pair or set"})
    EXPECT_NE(all.document.second.find(fmt::format("\"name\": \"{}\"", name)), std::string::npos)
        << name;
}

}  // namespace
}  // namespace drift::target_words_test
