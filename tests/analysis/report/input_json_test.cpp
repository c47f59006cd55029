// What is the matter with the input, for machines: alike in both documents.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/identify/input_doubts.hpp"
#include "analysis/report/identify/sections.hpp"
#include "tests/analysis/report/identify/identification_fixture.hpp"

namespace drift::input_json_test {
namespace {

using identification::Spike;

constexpr const char* off_zero = "b.csv:gimbal_inner: it reads 1 deg too much";

/// A spike of the second recording, or one in the last row of three positions.
std::vector<Spike> spikes(bool late) {
  if (!late) return {{3, 6060.0, 4, false, 2}};
  return {{0, 60.0, 1, true}, {1, 120.0, 2, true}, {2, 180.0, 3, true}};
}

nlohmann::json identified(const std::vector<Spike>& of, const std::string& zero) {
  const mc::Study study = test::study();
  identification::Identification id = test::identification(study);
  id.spikes = of;
  id.off_zero = zero;
  id.names = {"a.csv", "b.csv"};
  id.remarks = {"what was done when it was read"};
  return nlohmann::json::parse(report::identification_document(study, id).dump());
}

nlohmann::json diagnosed(const std::vector<Spike>& of, const std::string& zero) {
  diagnosis::Diagnosis d;
  if (!zero.empty()) d.remarks.emplace_back(diagnosis::remark::GimbalOffZero{zero});
  if (!of.empty()) d.remarks.emplace_back(diagnosis::remark::SamplesLeftOut{of, 0});
  return nlohmann::json::parse(report::to_json(d));
}

TEST(InputJson, HasTheGimbalThatIsOffTheOutliersAndLateLabels) {
  for (const auto document : {identified, diagnosed}) {
    const auto one = document(spikes(false), off_zero);
    EXPECT_EQ(one["gimbal_zero"], off_zero);
    ASSERT_EQ(one["outliers"].size(), 1u);
    EXPECT_EQ(
        one["outliers"][0],
        nlohmann::json(
            {{"channel", "gimbal_outer"}, {"position", 4}, {"time_s", 6060.0}, {"recording", 2}}));
    EXPECT_EQ(one["late_labels"], 0);
    const auto late = document(spikes(true), "");
    EXPECT_TRUE(late["gimbal_zero"].is_null());
    EXPECT_EQ(late["outliers"].size(), 3u);
    EXPECT_EQ(late["outliers"][1]["channel"], "acc_y");
    EXPECT_EQ(late["late_labels"], 3);
    const auto none = document({}, "");
    EXPECT_TRUE(none["outliers"].is_array() && none["outliers"].empty());
  }
}

TEST(InputJson, OfIdentifyHasTheSentencesOfTheTextAmongItsRemarks) {
  const auto remarks = identified(spikes(false), off_zero)["remarks"];
  ASSERT_EQ(remarks.size(), 3u);
  EXPECT_EQ(remarks[0], std::string(off_zero) + ".");
  EXPECT_NE(remarks[1].get<std::string>().find("gimbal_outer in position 4 at 6060 s of b.csv"),
            std::string::npos);
  EXPECT_EQ(remarks[2], "what was done when it was read");
  EXPECT_EQ(identified(spikes(true), "")["remarks"][0].get<std::string>().find(
                "In the last row of 3 positions"),
            0u);
}

}  // namespace
}  // namespace drift::input_json_test
