// Short runs of one reading: what chance makes of a channel, and a sensor that hangs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/preparation/held_rows.hpp"
#include "core/base/rng.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::stuck_by_chance_test {
namespace {

/// Six positions of an hour of minutes.
Recording minutes() {
  return test::simulated(test::six_study(3600.0, 60.0));
}

/// Of a channel without steps five are found: 360 runs of which one repeats, by the rule of
/// succession 360 * sqrt(2)^4 * 4! / (361 * 362 * 363 * 364) = 2e-6, and of four 1.3e-4.
TEST(StuckSensor, FiveEqualReadingsOfAChannelThatNeverRepeatsAreFound) {
  const Recording right = minutes();
  EXPECT_TRUE(stuck_rows(right).empty());
  for (const char* name : {"acc_y", "gimbal_middle"})
    for (const std::size_t rows : {4u, 5u, 11u, 19u}) {
      Recording r = right;
      std::vector<double>& x = test::channel(r, name);
      std::fill_n(x.begin() + 130, rows, x[130]);
      const auto found = stuck_rows(r);
      if (rows < 5) {
        EXPECT_TRUE(found.empty());
        continue;
      }
      ASSERT_EQ(found.size(), 1u) << name << " " << rows;
      EXPECT_EQ(found.front().channel, name);
      EXPECT_EQ(found.front().first, 130u);
      EXPECT_EQ(found.front().end, 130u + rows);
      std::vector<std::string> remarks;
      leave_out_stuck(r, remarks);
      ASSERT_EQ(remarks.size(), 1u);
      EXPECT_NE(remarks.front().find(fmt::format("stands still for {} samples", rows)),
                std::string::npos)
          << remarks.front();
      EXPECT_TRUE(std::isnan(test::channel(r, name)[130]));
      EXPECT_TRUE(std::isfinite(test::channel(r, name)[130 + rows]));
    }
}

/// Steps of a half to some sigma of the noise, in positions where the reading stands and in others
/// where it moves by many steps a row: 200 logs of two channels, by chance 0.04.
TEST(StuckSensor, ChanceDoesNotMakeOne) {
  std::size_t found = 0;
  for (std::uint64_t run = 0; run < 200; ++run) {
    Stream stream(7, run, Purpose::test, 0);
    Recording r;
    r.channels = {{"position", unit::one, {}}, {"acc_x", unit::g, {}}, {"acc_y", unit::g, {}}};
    const double step = std::pow(2.0, static_cast<double>(run % 6) - 4.0);  // [sigma]
    for (std::size_t row = 0; row < 1200; ++row) {
      const double position = 1.0 + std::floor(static_cast<double>(row) / 200.0),
                   slope = static_cast<int>(position) % 2 == 0 ? 0.0 : 3.0;
      r.channels[0].values.push_back(position);
      for (const std::size_t c : {1u, 2u})
        r.channels[c].values.push_back(
            step * std::round((slope * static_cast<double>(row) + stream.normal()) / step));
      r.lines.push_back(row + 2);
    }
    found += stuck_rows(r).size();
  }
  EXPECT_EQ(found, 0u);
}

/// As a plan of slews, a level platform and coarse readouts have it.
TEST(StuckSensor, NothingIsFoundInRecordingsThatAreRight) {
  for (const std::string_view preset : preset_names)
    for (const CommandLaw mode : {CommandLaw::free, CommandLaw::level})
      for (const double steps : {0.0, 0.1, 0.5, 1.0, 2.0, 8.0}) {  // of 5 ug and 5 arcsec
        PlanDefaults defaults;
        defaults.dwell = 1800.0;
        defaults.sample = 30.0;
        defaults.mode = mode;
        mc::Study study = test::six_study();
        study.plan = preset_plan(preset, defaults).value();
        Recording r = test::simulated(study);
        for (Channel& c : r.channels) {
          const double step = c.name.starts_with("acc_")      ? steps * 5e-6
                              : c.name.starts_with("gimbal_") ? steps * 5.0 * unit::arcsec.to_si
                                                              : 0.0;
          if (step > 0.0)
            for (double& x : c.values) x = std::round(x / step) * step;
        }
        EXPECT_TRUE(stuck_rows(r).empty()) << preset << " " << steps;
      }
}

}  // namespace
}  // namespace drift::preparation::stuck_by_chance_test
