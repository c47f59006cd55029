// Recordings with something broken: what is lost is said, and the channel named.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/judge.hpp"
#include "analysis/strapdown/case_identify.hpp"
#include "analysis/strapdown/checks/saturated.hpp"
#include "core/base/check.hpp"
#include "core/base/nan.hpp"
#include "core/recording/rows/quality_card.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::damaged_recording_test {
namespace {

mc::Study study() {
  return mc::read_study_text(test::strapdown_study("45 deg", "9.8 m/s^2"), "study.toml");
}

Recording made(std::uint64_t seed = 3) {
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) test::set(theta, key, 900.0);
  return test::strapdown_recording({.dwells = 12, .rest = 4.0, .gyro_noise = 1e-4, .seed = seed},
                                   theta);
}

std::vector<double>& channel(Recording& r, std::string_view name) {
  return std::ranges::find(r.channels, name, &Channel::name)->values;
}

std::string refusal(const Recording& recording) {
  try {
    case_study(study(), recording);
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::recording);
    return e.messages().front();
  }
  return "";
}

TEST(DamagedRecording, ALoneEmptyCellOfATurnIsBridgedAndTwoInARowAreAGapThatIsSaid) {
  const CaseStudy whole = case_study(study(), made());
  ASSERT_EQ(whole.test.ways.size(), 11u);
  // A rest of 4 s at 100 Hz, then a turn of 2.5 s.
  constexpr std::size_t period = 650, in_turn = 400 + 100;
  Recording r = made();
  for (std::size_t d = 0; d < 11; ++d)
    channel(r, d % 2 == 0 ? "gyro_x" : "acc_z")[d * period + in_turn] = nan_value;
  const CaseStudy bridged = case_study(study(), r);
  EXPECT_EQ(bridged.test.ways, whole.test.ways);
  EXPECT_TRUE(bridged.remarks.empty());
  EXPECT_EQ(quality_card(r, RecordingKind::strapdown).empty, 11u);
  EXPECT_NE(to_text(quality_card(r, RecordingKind::strapdown)).find("cells without a number: 11"),
            std::string::npos);
  channel(r, "gyro_x")[in_turn + 1] = nan_value;
  const CaseStudy lost = case_study(study(), r);
  EXPECT_EQ(lost.test.ways.size(), 10u);
  ASSERT_EQ(lost.remarks.size(), 1u);
  EXPECT_NE(lost.remarks[0].find("1 of the 11 turns between dwells is left out for gaps"),
            std::string::npos)
      << lost.remarks[0];
}

TEST(DamagedRecording, RowsOfZerosAreNotMeasured) {
  const CaseStudy whole = case_study(study(), made());
  Recording r = made();
  std::size_t rows = 0;
  for (std::size_t row = 57; row < r.rows(); row += 501, ++rows)
    for (const char* name : {"gyro_x", "gyro_y", "gyro_z", "acc_x", "acc_y", "acc_z"})
      channel(r, name)[row] = 0.0;
  const CaseStudy filled = case_study(study(), r);
  EXPECT_EQ(filled.test.ways, whole.test.ways);
  ASSERT_EQ(filled.search.dwells.size(), whole.search.dwells.size());
  for (std::size_t d = 0; d < whole.search.dwells.size(); ++d)
    EXPECT_LT((filled.search.dwells[d].acc - whole.search.dwells[d].acc).norm(), 1e-4) << d;
  ASSERT_EQ(filled.remarks.size(), 1u);
  EXPECT_NE(filled.remarks[0].find(fmt::format("all read 0 g in {} rows", rows)), std::string::npos)
      << filled.remarks[0];
}

TEST(DamagedRecording, AGyroAtTheEndOfItsRangeIsLeftOutAsIfItWereMissingAndSaidFirst) {
  Recording clipped = made(), missing = made();
  double fastest = 0.0;
  for (const double v : channel(clipped, "gyro_y")) fastest = std::max(fastest, std::abs(v));
  const double limit = 0.8 * fastest;
  std::size_t rows = 0;
  for (double& v : channel(clipped, "gyro_y")) v = std::clamp(v, -limit, limit);
  for (double& v : channel(missing, "gyro_y"))
    if (std::abs(v) >= limit) {
      v = nan_value;
      ++rows;
    }
  ASSERT_GT(rows, 2u);
  const CaseStudy cut = case_study(study(), clipped), left_out = case_study(study(), missing);
  EXPECT_LT(cut.test.ways.size(), 11u);
  EXPECT_EQ(cut.test.ways, left_out.test.ways);
  EXPECT_EQ(cut.test.measured.acc.cols(), left_out.test.measured.acc.cols());
  ASSERT_FALSE(cut.saturated.empty());
  EXPECT_EQ(cut.all_remarks().front(), cut.saturated);
  for (const char* part :
       {"gyro_y in turn", " deg/s, its ", "A gyro at the end of its range", "set a larger range"})
    EXPECT_NE(cut.saturated.find(part), std::string::npos) << cut.saturated;
  EXPECT_TRUE(left_out.saturated.empty());
}

TEST(DamagedRecording, TurnsAreCountedFromTheDwellBeforeThem) {
  std::vector<Dwell> dwells(2);
  dwells[0].first = 10;
  dwells[1].first = 30;
  std::vector<double> time(60);
  for (std::size_t k = 0; k < time.size(); ++k) time[k] = 0.1 * static_cast<double>(k);
  const auto turns = turns_of({5, 6, 20, 21, 25, 50}, time, dwells);
  ASSERT_EQ(turns.size(), 3u);
  EXPECT_EQ(turns[0].number, 0u);
  EXPECT_EQ(turns[1].number, 1u);
  EXPECT_DOUBLE_EQ(turns[1].time, 2.0);
  EXPECT_EQ(turns[2].number, 2u);
}

TEST(DamagedRecording, AnAccelerometerThatStandsStillIsNamedWhereNothingIsQuiet) {
  Recording r = made();
  std::ranges::fill(channel(r, "acc_y"), 0.01);
  const std::string said = refusal(r);
  EXPECT_NE(said.find("acc_y (0 s at most) is not measured"), std::string::npos) << said;
  EXPECT_EQ(said.find("acc_x"), std::string::npos) << said;
}

TEST(DamagedRecording, AnAccelerometerThatReadsNoiseAloneIsNamedAndALiveOneIsNot) {
  EXPECT_EQ(refusal(made()), "");
  for (const char* name : {"acc_x", "acc_y", "acc_z"}) {
    Recording r = made();
    Stream noise(1, 0, Purpose::test, 7);
    for (double& v : channel(r, name)) v = 0.001 * noise.normal();
    const std::string said = refusal(r);
    EXPECT_NE(said.find(std::string(name) + ": in 12 rests it reads"), std::string::npos) << said;
  }
}

TEST(DamagedRecording, RestsThatAreTooShortAreSaidWithTheirLengthAndThatOfTheQuietInThem) {
  const std::string said = refusal(test::strapdown_recording(
      {.dwells = 12, .rest = 2.0, .gyro_noise = 1e-4, .seed = 3}, Theta::Zero()));
  EXPECT_NE(said.find("no dwell of 2 s"), std::string::npos) << said;
  EXPECT_NE(said.find("the longest quiet stretch lasts 1."), std::string::npos) << said;
  EXPECT_NE(said.find("quiet is judged over 0.5 s: a rest has to last 2.5 s to be quiet for 2 s"),
            std::string::npos)
      << said;
}

TEST(DamagedRecording, TimesInMillisecondsUnderSecondsAreAskedFor) {
  Recording r = made();
  for (double& t : channel(r, "time")) t *= 1000.0;
  const std::string said = refusal(r);
  EXPECT_NE(said.find("the times: they look like [ms], not [s]. Write time [ms]"),
            std::string::npos)
      << said;
  r = made();
  for (double& t : channel(r, "time")) t *= 1e-3;
  EXPECT_NE(refusal(r).find("by its times the recording lasts 0.0"), std::string::npos);
}

TEST(DamagedRecording, WhatFitsByNoMeansIsNotConsistentThoughNothingIsFound) {
  const CaseStudy of = case_study(study(), made());
  const FilterSpec filter = case_filter(study().filters.front(), of);
  Measurements measured = of.test.measured;
  const MeasuredTest test{of.test.timeline, of.test.readout, measured};
  const auto judged = [&] {
    const BatchResult fit = fit_batch(filter, test, start_of(filter, of));
    const search::Fitted nominal =
        search::examine(filter, test, fit, {.model = search::declared_noise(filter)});
    return diagnosis::judge(nominal, search::Search{}, {}, {}, {}, diagnosis::NamedBy::held_out);
  };
  EXPECT_EQ(judged().verdict, diagnosis::Verdict::consistent);
  // Ten times the noise that is taken for known: a chi-square of about a hundred per row.
  Stream noise(1, 0, Purpose::test, 8);
  for (Eigen::Index i = 0; i < measured.acc.cols(); ++i)
    for (int a = 0; a < 3; ++a)
      measured.acc(a, i) += 10.0 * test.readout.accelerometer_noise * noise.normal();
  const diagnosis::Judged far = judged();
  EXPECT_EQ(far.verdict, diagnosis::Verdict::unexplained);
  ASSERT_TRUE(far.of_no_noise.has_value());
  EXPECT_LT(*far.of_no_noise, 1e-6);
}

}  // namespace
}  // namespace drift::strapdown::damaged_recording_test
