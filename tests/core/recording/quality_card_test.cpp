#include "core/recording/rows/quality_card.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "recording_fixture.hpp"
#include "tests/support/recordings_by_others.hpp"

namespace drift::quality_card_test {
namespace {

using namespace test;

TEST(QualityCard, KnowsGapsWithinPositionsFromThoseBetween) {
  Recording r = platform_recording();
  r.lines.resize(40);
  for (std::size_t i = 0; i < 40; ++i) r.lines[i] = i + 2;
  for (std::size_t i = 10; i < 40; ++i) r.channels[0].values[i] += 180.0;  // three samples lost
  const QualityCard card = quality_card(r, RecordingKind::platform);
  EXPECT_EQ(card.rows, 40u);
  EXPECT_EQ(card.positions, 2u);
  EXPECT_DOUBLE_EQ(card.span, 39 * 60.0 + 180.0 + 1234.5);
  EXPECT_DOUBLE_EQ(card.interval, 60.0);
  EXPECT_NEAR(card.jitter, 0.0, 1e-9);
  ASSERT_EQ(card.gaps.size(), 1u);
  EXPECT_EQ(card.gaps[0].line, 12u);
  EXPECT_DOUBLE_EQ(card.gaps[0].length, 240.0);
  EXPECT_DOUBLE_EQ(card.gaps[0].start, 600.0);
  EXPECT_DOUBLE_EQ(card.lost, 3.0);
  ASSERT_EQ(card.between.size(), 1u);
  EXPECT_DOUBLE_EQ(card.between[0].length, 1294.5);
  const std::string text = to_text(card);
  for (const char* part :
       {"40 rows", "2 positions", "gaps 1, largest 240 s after 600 s (line 12)",
        "normal if the platform was caged", "# sensor = test table", "covariate"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 40) << "more than one screen";
}

TEST(QualityCard, MeasuresJitterAgainstTheMedianOfEachPosition) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"position", unit::one, {}}};
  double t = 0.0;
  for (int i = 0; i < 200; ++i) {
    t += i < 100 ? 1.0 : 10.0;
    r.channels[0].values.push_back(t + (i % 4 == 1 ? 0.1 : 0.0));
    r.channels[1].values.push_back(i < 100 ? 1 : 2);
    r.lines.push_back(static_cast<std::size_t>(i) + 1);
  }
  const QualityCard card = quality_card(r, RecordingKind::platform);
  // Of four intervals one is 0.1 longer and one 0.1 shorter: rms 0.1 / sqrt(2), but for the ends.
  EXPECT_NEAR(card.jitter, 0.1 / std::sqrt(2.0), 1e-3);
  EXPECT_TRUE(card.gaps.empty()) << "an interval ten times longer is another position's own";
}

TEST(QualityCard, FindsStuckAndSaturatedSensorsAndCountsWhatIsMissing) {
  Recording r;
  r.channels = {
      {"time", unit::s, {}}, {"acc_x", *parse_unit("mg"), {}}, {"cmd_x", unit::deg_per_h, {}}};
  for (int i = 0; i < 200; ++i) {
    r.channels[0].values.push_back(i);
    double x = 0.1 + 0.001 * ((i * 37) % 50);
    if (i >= 30 && i < 55) x = 0.12;
    if ((i >= 60 && i < 64) || (i >= 70 && i < 73)) x = 2.0;
    r.channels[1].values.push_back(i == 5 || i == 6 ? NAN : x);
    r.channels[2].values.push_back(0.0);
    r.lines.push_back(static_cast<std::size_t>(i) + 10);
  }
  const QualityCard card = quality_card(r, RecordingKind::platform);
  ASSERT_EQ(card.channels.size(), 2u);
  const auto& acc = card.channels[0];
  EXPECT_EQ(acc.missing, 2u);
  EXPECT_EQ(acc.measured, 198u);
  EXPECT_EQ(acc.stuck, 25u);
  EXPECT_EQ(acc.stuck_line, 40u);
  EXPECT_EQ(acc.saturated(), 2u);
  EXPECT_DOUBLE_EQ(acc.max, 2000.0);
  const std::string text = to_text(card);
  EXPECT_NE(text.find("acc_x: 25 identical samples from line 40"), std::string::npos) << text;
  EXPECT_EQ(text.find("cmd_x: "), std::string::npos) << "a constant command is no stuck sensor\n"
                                                     << text;
}

TEST(QualityCard, MeanAndDeviationAreThoseOfTheDefinition) {
  Recording r;
  r.channels = {{"time", unit::s, {1, 2, 3, 4}},
                {"temperature", *parse_unit("degC"), {1e9, 1e9 + 1, 1e9 + 2, 1e9 + 3}}};
  r.lines = {1, 2, 3, 4};
  const auto card = quality_card(r, RecordingKind::platform);
  EXPECT_DOUBLE_EQ(card.channels[0].mean, 1e9 + 1.5);
  EXPECT_NEAR(card.channels[0].sd, std::sqrt(5.0 / 3.0), 1e-9);
  EXPECT_TRUE(card.channels[0].covariate);
}

TEST(QualityCard, SaysWhatIsTakenForGranted) {
  const Folder folder;
  const auto r = read_recording(
      folder.write("r.csv", "time [s],position,acc_x [g],acc_y [g],acc_z [g]\n1,1,0,,0\n"),
      RecordingKind::platform, gravity);
  const std::string text = to_text(quality_card(r, RecordingKind::platform));
  for (const char* part : {"(CSV): 1 rows", "no commands (cmd_*): those of the plan are taken",
                           "taken as dwell", "no gimbal angles", "acc_y: nothing was measured"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(QualityCard, ACoarseReadoutIsSaidByItsStepAndIsNoStuckSensor) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"acc_x", *parse_unit("mg"), {}}};
  for (int i = 0; i < 200; ++i) {
    r.channels[0].values.push_back(i);
    r.channels[1].values.push_back(0.002 * std::round(0.05 * i / 2.0));  // a step in 40 rows
    r.lines.push_back(static_cast<std::size_t>(i) + 2);
  }
  const std::string text = to_text(quality_card(r, RecordingKind::platform));
  EXPECT_NE(text.find("acc_x: its readings are steps of 2 mg"), std::string::npos) << text;
  EXPECT_EQ(text.find("stuck sensor?"), std::string::npos) << text;
  EXPECT_EQ(text.find("saturated?"), std::string::npos) << text;
}

TEST(QualityCard, OneCountOrNoneIsACoarseReadoutAndNotSaturated) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"acc_x", *parse_unit("mg"), {}}};
  for (int i = 0; i < 300; ++i) {
    r.channels[0].values.push_back(i);
    r.channels[1].values.push_back(i % 5 == 0 ? 0.002 : 0.0);
    r.lines.push_back(static_cast<std::size_t>(i) + 2);
  }
  const auto said = [&] { return to_text(quality_card(r, RecordingKind::platform)); };
  EXPECT_NE(said().find("acc_x: its readings are steps of 2 mg"), std::string::npos) << said();
  EXPECT_EQ(said().find("saturated?"), std::string::npos) << said();
  // Two values that follow each other once are no grid.
  for (int i = 0; i < 300; ++i)
    r.channels[1].values[static_cast<std::size_t>(i)] = i < 150 ? 0.0 : 0.002;
  EXPECT_NE(said().find("a stuck sensor?"), std::string::npos) << said();
}

TEST(QualityCard, ColumnsThatMayBeCommandsAreDoubtedFirst) {
  const Folder folder;
  const auto r = read_recording(
      folder.write("r.csv",
                   "Run 7\ntime [s],position,acc_x [g],acc_y [g],acc_z [g],torq_1 [deg/h]\n"
                   "1,1,0,0,1,7.5\n2,1,0,0,1,7.5\n"),
      RecordingKind::platform, gravity);
  const auto said = quality_card(r, RecordingKind::platform).remarks.texts();
  ASSERT_FALSE(said.empty());
  EXPECT_NE(said[0].find("those of the plan are taken, though torq_1 is in a unit of rates"),
            std::string::npos)
      << said[0];
}

TEST(QualityCard, SaysWhatIsWrongBeforeWhatIsNoted) {
  const Folder folder;  // four remarks on how it was read come first in the file
  const auto r =
      read_recording(folder.write("r.csv",
                                  "Run 7\nJ. Doe\ntime,position,acc_x,acc_y,acc_z,text\ns,,g,g,g,\n"
                                  "1,1,0,,0,a\n2,1,0,,1,b\n3,1,"),
                     RecordingKind::platform, gravity);
  const auto said = quality_card(r, RecordingKind::platform).remarks.texts();
  ASSERT_GE(said.size(), 6u);
  EXPECT_EQ(said[0], "acc_y: nothing was measured");
  EXPECT_EQ(said[1], "no gimbal angles");
}

TEST(QualityCard, ATemperatureOfARoomInDegreesFahrenheitIsAskedAbout) {
  const auto asked = [](double mean, const char* unit = "degC") {
    const Folder folder;
    std::string text =
        fmt::format("time [s],position,acc_x [g],acc_y [g],acc_z [g],temperature [{}]\n", unit);
    for (int i = 0; i < 4; ++i) text += fmt::format("{},1,0,0,1,{}\n", i + 1, mean - 1.5 + i);
    const auto r = read_recording(folder.write("r.csv", text), RecordingKind::platform, gravity);
    const auto said = quality_card(r, RecordingKind::platform).remarks.texts();
    return std::ranges::any_of(
        said, [](const std::string& s) { return s.find("is it degF (") != std::string::npos; });
  };
  // 15 degC, the coldest laboratory, are 59 degF; 85 degC, the hottest chamber, are 185 degF.
  EXPECT_FALSE(asked(58.9));
  EXPECT_TRUE(asked(59.1));
  EXPECT_TRUE(asked(184.9));
  EXPECT_FALSE(asked(185.1));
  EXPECT_FALSE(asked(72.0, "degF"));
  EXPECT_FALSE(asked(300.0, "K"));
}

TEST(QualityCard, SaysWhichSensorOfAPlatformIsNotThere) {
  const Folder folder;
  const auto r = read_recording(
      folder.write("r.csv",
                   "time [s],position,acc_x [g],acc_z [g],gimbal_outer [deg]\n1,1,0,0,0\n"),
      RecordingKind::platform, gravity);
  const std::string text = to_text(quality_card(r, RecordingKind::platform));
  for (const char* part : {"no acc_y: taken as not measured",
                           "no gimbal_middle: taken as not measured", "no gimbal_inner: taken"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  EXPECT_EQ(text.find("no accelerometers"), std::string::npos) << text;
}

class RealRecording : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Recording, RealRecording,
                         ::testing::Values("xsens_mti.csv", "mpu9150_0.csv", "mpu9150_1.csv"),
                         [](const auto& one) {
                           const std::string name = one.param;
                           return name.substr(0, name.find('.'));
                         });

TEST_P(RealRecording, ReadsCleanlyAndAlikeInEveryFormat) {
  NEEDS_RECORDING(GetParam());
  const std::string path = path_of(GetParam());
  const Recording r = read_recording(path, RecordingKind::strapdown, gravity);
  const QualityCard card = quality_card(r, RecordingKind::strapdown);
  std::cout << GetParam() << ": " << card.rows << " rows, " << card.span << " s\n";
  EXPECT_GT(card.rows, 15000u);
  EXPECT_NEAR(card.interval, 0.01, 1e-4);
  if (std::string_view(GetParam()) == "xsens_mti.csv") {
    EXPECT_NEAR(card.span, 511.7, 0.1);
  }
  const Folder folder;
  for (const char* name : {"copy.csv", "copy.h5", "copy.mat"}) {
    write_recording(r, folder / name);
    const Recording copy = read_recording(folder / name, RecordingKind::strapdown, gravity);
    for (const auto& c : r.channels)
      EXPECT_EQ(c.values, copy.find(c.name)->values) << name << " " << c.name;
  }
}

}  // namespace
}  // namespace drift::quality_card_test
