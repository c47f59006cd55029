// Single readings that are none, among rows that are joined.
#include "analysis/preparation/rows/raw_spikes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "analysis/preparation/prepare.hpp"
#include "core/plan/test_plan.hpp"
#include "core/recording/recording_channels.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::raw_spikes_test {
namespace {

using preparation::raw_spikes;

/// Six positions of 600 rows, 2 s apart.
Recording fine_rows() {
  return test::simulated(test::six_study(1200.0, 2.0));
}

/// Far from each other, two beside each other, and two with one between them.
const std::vector<std::size_t> astray{100, 700, 1000, 1001, 1500, 1502, 2500, 3300};

TEST(RawSpikes, AreFoundAmongFineRowsAndLeftOutOfTheirMeans) {
  const Recording right = fine_rows();
  for (const double size : {1.0, 3e-3}) {  // [g]; Up turns by 1.5e-4 a row
    Recording wrong = right;
    for (const std::size_t row : astray) test::channel(wrong, "acc_x")[row] += size;
    const auto found = raw_spikes(wrong);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().channel, "acc_x");
    EXPECT_EQ(found.front().rows, astray);
    const mc::Study study = test::six_study(1200.0, 60.0);  // thirty rows become one
    const auto clean = preparation::prepare(study, {right}),
               spiked = preparation::prepare(study, {wrong});
    EXPECT_TRUE(std::ranges::any_of(spiked.remarks, [](const std::string& text) {
      return text.find(
                 "acc_x: 8 isolated readings far from those around (lines 101, 701, 1001, "
                 "1002, 1501 and 3 more)") != std::string::npos;
    })) << spiked.remarks.front();
    const auto &before = clean.recordings.front().find("acc_x")->values,
               &after = spiked.recordings.front().find("acc_x")->values;
    ASSERT_EQ(before.size(), after.size());
    // One or two of thirty are bridged: 5 ug * sqrt(2) * sqrt(2) / 30, five sigma of it.
    for (std::size_t k = 0; k < before.size(); ++k)
      EXPECT_NEAR(after[k], before[k], 5.0 * 5e-6 * 2.0 / 30.0) << k;
  }
}

TEST(RawSpikes, OfAnglesAreFoundAcrossAWholeTurn) {
  Recording r = fine_rows();
  std::vector<double>& outer = test::channel(r, "gimbal_outer");
  for (double& x : outer) x = std::fmod(x + 720.0 * detail::deg, 360.0 * detail::deg);
  outer[1400] += 0.1 * detail::deg;
  const auto found = raw_spikes(r);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().rows, std::vector<std::size_t>{1400});
}

/// Of rows as long as the plan's samples the fit tells.
TEST(RawSpikes, AreLeftToTheFitWhereRowsStayAsTheyAre) {
  const mc::Study study = test::six_study(1200.0, 20.0);
  Recording r = test::simulated(study);
  test::channel(r, "acc_x")[100] += 0.01;
  const auto ready = preparation::prepare(study, {r});
  EXPECT_TRUE(std::isfinite(ready.recordings.front().find("acc_x")->values[100]));
}

TEST(RawSpikes, AreNoneAmongMostOfTheReadings) {
  Recording r = fine_rows();
  for (std::size_t row = 10; row < r.rows(); row += 20) test::channel(r, "acc_y")[row] += 0.01;
  EXPECT_TRUE(raw_spikes(r).empty());
}

/// Plans of every kind, slews, and readouts of coarse steps.
TEST(RawSpikes, AreNotThereWhereNothingIsWrong) {
  for (const std::string_view preset : preset_names)
    for (const Entry entry : {Entry::caged, Entry::torqued}) {
      PlanDefaults defaults;
      defaults.dwell = 1200.0;
      defaults.sample = 10.0;
      defaults.entry = entry;
      mc::Study study = test::six_study();
      study.plan = preset_plan(preset, defaults).value();
      Recording r = test::simulated(study);
      EXPECT_TRUE(raw_spikes(r).empty()) << preset;
      for (Channel& c : r.channels) {
        const double step = c.name.starts_with("acc_")      ? 1e-4
                            : c.name.starts_with("gimbal_") ? 0.05 * detail::deg
                                                            : 0.0;
        if (step > 0.0)
          for (double& x : c.values) x = std::round(x / step) * step;
      }
      EXPECT_TRUE(raw_spikes(r).empty()) << preset << ", coarse";
    }
}

}  // namespace
}  // namespace drift::raw_spikes_test
