#include <gtest/gtest.h>

#include <regex>

#include "tests/mc/study/study_file.hpp"
#include "tests/mc/study/study_mistake_cases.hpp"

namespace drift::study_mistakes_test {
namespace {

using test::Case, test::cases, test::right;

std::string with(const Case& c) {
  std::string text;
  for (std::size_t i = 0; i < right.size(); ++i)
    text += (i + 1 == c.line ? c.text : right[i]) + "\n";
  return text;
}

TEST(StudyMistakes, TheUnchangedStudyHasNone) {
  EXPECT_TRUE(test::mistakes(with({0, "", "", {}})).empty());
}

TEST(StudyMistakes, EachIsLocatedExplainedAndTheOnlyOneReported) {
  // "file:line:col: what is wrong (what is expected). What to do"
  const std::regex grammar("study\\.toml:[0-9]+:[0-9]+: [^]+ \\(expected [^]+\\)\\. [^]+");
  for (const auto& c : cases) {
    const auto found = test::mistakes(with(c));
    ASSERT_EQ(found.size(), 1u) << c.text << "\n" << testing::PrintToString(found);
    EXPECT_TRUE(found[0].starts_with("study.toml:" + c.at + ": ")) << c.text << "\n" << found[0];
    EXPECT_TRUE(std::regex_match(found[0], grammar)) << found[0];
    for (const auto& part : c.says)
      EXPECT_NE(found[0].find(part), std::string::npos) << c.text << "\n"
                                                        << part << "\n"
                                                        << found[0];
  }
  EXPECT_GE(std::size(cases), 100u);
}

TEST(StudyMistakes, AllOfAFileAreReportedAtOnceInItsOrder) {
  std::string text;
  for (std::size_t i = 0; i < right.size(); ++i) {
    std::string line = right[i];
    if (i + 1 == 4) line = "latitude = 45";
    if (i + 1 == 7) line = "dwel = \"60 min\"";
    if (i + 1 == 9) line = "gimbals = 1";
    if (i + 1 == 12) line = "terms = [\"fixed_drit\"]";
    if (i + 1 == 14) line = "eta_x = \"1 s\"";
    if (i + 1 == 17) line = "coupling = \"servo\"";
    if (i + 1 == 19) line = "runs = -1";
    text += line + "\n";
  }
  const auto found = test::mistakes(text);
  ASSERT_EQ(found.size(), 7u) << testing::PrintToString(found);
  const char* places[] = {"4:12", "7:1", "9:11", "12:10", "14:9", "17:12", "19:8"};
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_TRUE(found[i].starts_with(std::string("study.toml:") + places[i] + ": ")) << found[i];
}

}  // namespace
}  // namespace drift::study_mistakes_test
