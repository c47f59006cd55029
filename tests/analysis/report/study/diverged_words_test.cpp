// A study in which a filter diverged: its short answers do not take that for a parameter that is
// off.
#include <gtest/gtest.h>

#include "analysis/report/study/sections.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::diverged_words_test {
namespace {

using namespace drift::test;
using C = mc::StudyColumns;

/// The small study, in whose first `diverged` runs of 20 the wrong filter has no estimate.
std::string headline_of_the_wrong_filter(std::size_t diverged) {
  constexpr std::size_t runs = 20;
  report::StudyResults results;
  results.study = read_text(small_study);
  results.points = mc::study_points(results.study);
  const mc::StudyTask task(results.points[0].study);
  const auto worker = task.worker();
  mc::Block block = run_block(task, *worker, 0, runs);
  const std::size_t status = task.layout().filters[1].at(0, C::status);
  for (std::size_t run = 0; run < diverged; ++run) {
    block.status[run] = mc::RunStatus::filter_diverged;
    block.rows[run * task.columns().size() + status] =
        static_cast<double>(EstimateStatus::diverged);
  }
  results.statistics.emplace_back(task.study());
  results.statistics.back().add(block);
  for (const std::string& line : report::headlines(results))
    if (line.find("filter wrong") != std::string::npos) return line;
  return "";
}

TEST(DivergedWords, ARunWithoutAnEstimateIsNotSaidToBeOff) {
  const std::string off = "some parameter that the filter claims to know is more than 5 sigma off";
  const std::string none = headline_of_the_wrong_filter(0), two = headline_of_the_wrong_filter(2);
  EXPECT_NE(none.find(off + "; silent failures"), std::string::npos) << none;
  EXPECT_EQ(none.find("diverged"), std::string::npos) << none;
  EXPECT_NE(two.find(off + ", or the filter diverged; silent failures"), std::string::npos) << two;
  EXPECT_NE(two.find("10.0 % (2.8 to 30.1) of the runs diverged, errors are of the others"),
            std::string::npos)
      << two;
}

}  // namespace
}  // namespace drift::diverged_words_test
