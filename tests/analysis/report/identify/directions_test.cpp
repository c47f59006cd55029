// What a test does not see, in the report of `identify`.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/report/identify/sections.hpp"
#include "tests/analysis/report/identify/identification_fixture.hpp"

namespace drift::identify_directions_test {
namespace {

TEST(IdentifyDirections, HasNoTableOfDirectionsWhereAllAreSeen) {
  const mc::Study study = test::study();
  identification::Identification id = test::identification(study);
  const auto said = [&] {
    std::string text = to_text(report::identification_report(study, id));
    std::ranges::replace(text, '\n', ' ');
    return text;
  };
  const std::string none = fmt::format("filter legacy does not see: none of {}. ",
                                       id.summaries[1].layout.size()),
                    headings = "signal  unrounded";
  EXPECT_NE(said().find(none), std::string::npos) << said();
  EXPECT_EQ(said().find("known better from the prior"), std::string::npos);
  EXPECT_EQ(said().find(headings), std::string::npos);
  id.summaries[1].weak = 4;
  EXPECT_NE(said().find(none + "4 are known better from"), std::string::npos) << said();
  id.summaries[1].weak = 1;
  EXPECT_NE(said().find(none + "1 is known better"), std::string::npos);
  // Of some the table stays.
  const auto n = static_cast<Eigen::Index>(id.summaries[1].layout.size());
  for (identification::FilterRun& run : id.runs)
    run.batch.information_root = (VecX::Ones(n) - VecX::Unit(n, 4)).asDiagonal();
  id.summaries[1].unseen = {{0.0, VecX::Unit(n, 4)}};
  id.summaries[1].weak = 4;
  EXPECT_NE(said().find("1 is not seen at all. 4 (with these) are known better"), std::string::npos)
      << said();
  EXPECT_NE(said().find(headings), std::string::npos);
}

}  // namespace
}  // namespace drift::identify_directions_test
