// Gyros of another scale, or times of another length, that no list of units has.
#include "analysis/strapdown/turn_scale.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/strapdown/case_study.hpp"
#include "core/base/check.hpp"
#include "tests/support/case_unit.hpp"

namespace drift::strapdown::turn_scale_test {
namespace {

mc::Study study_of_units() {
  return mc::read_study_text(
      test::strapdown_study(fmt::format("{} deg", case_unit::site.latitude / unit::deg.to_si),
                            "9.8 m/s^2"),
      "study.toml");
}

/// Columns times a factor.
struct Mistake {
  std::vector<const char*> columns;
  double factor;
};

Recording with(Recording recording, const Mistake& mistake) {
  for (const char* name : mistake.columns)
    for (Channel& channel : recording.channels)
      if (channel.name == name)
        for (double& value : channel.values) value *= mistake.factor;
  return recording;
}

const std::vector<const char*> all_gyros{"gyro_x", "gyro_y", "gyro_z"};

const Recording& right() {
  static const Recording recording =
      strapdown_recording(case_unit::script(75), case_unit::sensors());
  return recording;
}

bool says(const CaseStudy& of, const char* words) {
  return std::ranges::any_of(of.remarks, [&](const std::string& remark) {
    return remark.find(words) != std::string::npos;
  });
}

TEST(TurnScale, OneFactorThatMendsAllTurnsIsRefusedWithIt) {
  struct Case {
    Mistake mistake;
    const char *column, *factor, *mend;
  };
  for (const Case& c :
       {Case{{{"gyro_z"}, 2.0}, ":gyro_z: ", "gyro z turns 2 times", "Correct its scale"},
        Case{{{"gyro_x"}, 0.5}, ":gyro_x: ", "gyro x turns 0.5 times", "Correct its scale"},
        Case{{all_gyros, 0.5}, ":gyro_x: ", "the gyros turn 0.5 times", "Correct their scale: at"},
        Case{{{"time"}, 2.0}, ":time: ", "the gyros turn 2 times", "Correct the times, which"}}) {
    try {
      case_study(study_of_units(), with(right(), c.mistake));
      ADD_FAILURE() << c.factor;
    } catch (const InputError& e) {
      const std::string said = e.what();
      for (const char* words : {c.column, c.factor, c.mend})
        EXPECT_NE(said.find(words), std::string::npos) << words << "\n" << said;
    }
  }
}

/// A tenth is of a unit that does not see the Earth, three of its sigmas; of one that does it is
/// said, and so is what turns show of a clock.
TEST(TurnScale, ASmallerOneIsSaidWhereItIsBeyondThePrior) {
  const mc::Study study = study_of_units();
  EXPECT_FALSE(says(case_study(study, right()), "what gravity shows"));
  EXPECT_TRUE(says(case_study(study, with(right(), {{"gyro_z"}, 1.02})), "gyro z turns 1.0"));
  EXPECT_TRUE(says(case_study(study, with(right(), {{"time"}, 1.005})),
                   "all three alike: their scale, or the times"));
  EXPECT_FALSE(says(case_study(study, with(right(), {{"gyro_z"}, 1.001})), "what gravity shows"));
}

TEST(TurnScale, WhatAConsumersUnitMayBeOffByIsNotSaid) {
  test::StrapdownScript script = case_unit::script(76);
  script.gyro_noise = 0.01;
  script.acc_noise = 1.5e-3;
  const Recording recording = strapdown_recording(script, Theta::Zero());
  for (const double factor : {1.0, 1.03, 0.95})
    EXPECT_FALSE(says(case_study(study_of_units(), with(recording, {all_gyros, factor})),
                      "what gravity shows"))
        << factor;
  // Single turns are off by more than a tenth for their noise: it is said.
  EXPECT_TRUE(says(case_study(study_of_units(), with(recording, {all_gyros, 0.5})),
                   "all three alike: their scale, or the times"));
}

}  // namespace
}  // namespace drift::strapdown::turn_scale_test
