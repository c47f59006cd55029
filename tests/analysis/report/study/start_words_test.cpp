// Where the estimates that a study counts have started, in words.
#include <gtest/gtest.h>

#include "analysis/report/study/sections.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::start_words_test {
namespace {

using namespace drift::test;

report::Section crossed(const mc::Overrides& overrides) {
  report::StudyResults results;
  results.study = read_text(small_study, overrides);
  results.points = mc::study_points(results.study);
  const mc::StudyTask task(results.points[0].study);
  const auto worker = task.worker();
  results.statistics.emplace_back(task.study());
  results.statistics.back().add(run_block(task, *worker, 0, 2));
  return report::crossed(results);
}

std::string said(const mc::Overrides& overrides) {
  return std::get<report::Table>(crossed(overrides).blocks[0].content).note;
}

bool begins(const std::string& text, std::string_view with) {
  return text.starts_with(with);
}

TEST(StartWords, ThePriorMeanIsSaidWhereItIsSo) {
  constexpr std::string_view mean = "Filters started at the prior mean (start 1); other starts";
  EXPECT_PRED2(begins, said({}), mean);
  EXPECT_PRED2(begins, said({{"filter.right.starts", "[{}, { D_F_x = \"0.5 deg/h\" }]"}}), mean);
  EXPECT_PRED2(
      begins, said({{"filter.wrong.starts", "[{ D_F_x = \"0.5 deg/h\" }]"}}),
      "Filters started at the first of filter.starts, the prior mean where it says nothing "
      "(start 1); other starts");
}

TEST(StartWords, ThePageDoesNotSendItsReaderToTheReport) {
  for (const report::Block& block : crossed({}).blocks)
    if (const auto* table = std::get_if<report::Table>(&block.content);
        table != nullptr && table->title == "Truth against filter") {
      ASSERT_NE(block.on, report::On::both);
      const std::string_view where = block.on == report::On::page
                                         ? "other starts: see Starts below."
                                         : "other starts: report.";
      EXPECT_NE(table->note.find(where), std::string::npos) << table->note;
    }
}

}  // namespace
}  // namespace drift::start_words_test
