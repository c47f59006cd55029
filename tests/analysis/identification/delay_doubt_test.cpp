// Accelerometers that are momentary readings, and gimbals that are logged late, show another
// attitude than the other instrument.
#include "analysis/identification/delay_doubt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/identify/delay_words.hpp"
#include "core/recording/instants/shifted_readings.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::identification::delay_doubt_test {
namespace {

/// Six free positions of 20 minutes in rows of 10 s.
mc::Study study_of(double sample) {
  PlanDefaults defaults;
  defaults.dwell = 1200.0;
  defaults.sample = sample;
  defaults.mode = CommandLaw::free;
  return test::six_study(defaults);
}

/// Rows of 60 s whose accelerometers are means over the last 10 s: 25 s later than those over 60.
Recording momentary() {
  const Recording fine = test::simulated(study_of(10.0));
  Recording r = fine;
  r.lines.clear();
  for (Channel& c : r.channels) c.values.clear();
  for (std::size_t row = 5; row < fine.rows(); row += 6) {
    for (std::size_t k = 0; k < r.channels.size(); ++k)
      r.channels[k].values.push_back(fine.channels[k].values[row]);
    r.lines.push_back(row + 2);
  }
  return r;
}

/// Gimbals of the row before; that of the first row of a position is not known.
Recording late_gimbals() {
  Recording r = test::simulated(study_of(10.0));
  const std::vector<double> position = r.find("position")->values;
  for (Channel& c : r.channels) {
    if (!c.name.starts_with("gimbal_")) continue;
    for (std::size_t row = r.rows(); row-- > 0;)
      c.values[row] = row > 0 && position[row] == position[row - 1] ? c.values[row - 1] : nan_value;
  }
  return r;
}

std::optional<DelayDoubt> found_in(const mc::Study& study, const Recording& r) {
  const preparation::Prepared ready = preparation::prepare(study, {r});
  const auto test = dwells_alone(ready.study, ready.recordings);
  return test ? delay_of_misfit(*test, study.filters.front(), usual_interval({r})) : std::nullopt;
}

TEST(DelayDoubt, FindsMomentaryAccelerometersAndLateGimbals) {
  const auto readings = found_in(study_of(60.0), momentary());
  ASSERT_TRUE(readings);
  EXPECT_TRUE(readings->momentary());
  EXPECT_NEAR(readings->late, -25.0, 4.0 * readings->sigma);
  EXPECT_TRUE(readings->alone());
  EXPECT_EQ(readings->interval, 60.0);

  const auto rows = found_in(study_of(10.0), late_gimbals());
  ASSERT_TRUE(rows);
  EXPECT_FALSE(rows->momentary());
  EXPECT_NEAR(std::abs(rows->late), 10.0, 4.0 * rows->sigma);
  EXPECT_EQ(rows->late > 0.0, rows->of == DelayDoubt::Of::gimbals);
  EXPECT_LT(rows->sigma, 1.0);
}

TEST(DelayDoubt, NoneIsFoundInSoundRecordings) {
  for (const double sample : {10.0, 60.0})
    EXPECT_FALSE(found_in(study_of(sample), test::simulated(study_of(sample)))) << sample;
}

TEST(DelayDoubt, DiagnosisNamesNothingForIt) {
  diagnosis::RecordingsOptions options;
  options.diagnose.starts = 1;
  options.diagnose.whiteness_draws = 0;
  options.advising = diagnosis::Advising::left_out;
  const diagnosis::Diagnosis d =
      diagnosis::diagnose_recordings(study_of(60.0), {momentary()}, options);
  EXPECT_NE(d.verdict, diagnosis::Verdict::named) << report::sentence(d);
  EXPECT_EQ(report::sentence(d).find("Accelerometers and gimbals are of different instants"), 0u)
      << report::sentence(d);
  EXPECT_NE(report::diagnosis_in_brief(d).next.find("recording.accelerometers=momentary"),
            std::string::npos)
      << report::diagnosis_in_brief(d).next;
  const auto json = nlohmann::json::parse(report::to_json(d));
  EXPECT_TRUE(json["instants"]["momentary"].get<bool>());
}

TEST(DelayDoubt, WhatIsDeclaredIsPutRight) {
  Recording r = momentary();
  RecordingFormat format;
  format.accelerometers_late = -25.0;
  take_instants(r, format);
  const auto id = identify_recordings(study_of(60.0), {r}, 1);
  EXPECT_FALSE(id.delay);
  EXPECT_FALSE(misfit(id.counted(id.summaries.front()).batch.estimate));
}

TEST(DelayDoubt, IdentifySaysItToo) {
  const auto id = identify_recordings(study_of(60.0), {momentary()}, 1);
  ASSERT_TRUE(id.delay);
  EXPECT_NE(report::delay_text(*id.delay).find("momentary"), std::string::npos);
}

TEST(DelayDoubt, IsEvidentWhereItsEvidenceExceedsTheRarityOfDelays) {
  // 1000 to 1 against, and of 13.3 e-folds of size either way one is looked at: a gain of
  // 2 log(1000 x 2 x 13.3 x 10 / sqrt(2 pi)) = 23.1 for a delay of 10 sigma.
  DelayDoubt delay;
  delay.late = 1.0;
  delay.sigma = 0.1;
  delay.weigh(22.9);
  EXPECT_FALSE(delay.evident());
  delay.weigh(23.3);
  EXPECT_TRUE(delay.evident());
}

}  // namespace
}  // namespace drift::identification::delay_doubt_test
