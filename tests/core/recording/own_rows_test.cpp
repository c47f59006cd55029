// Lines of a user's own file that are no samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/recording/own/guess.hpp"
#include "recording_fixture.hpp"

namespace drift::own_rows_test {
namespace {

using namespace test;

const std::string imu_header =
    "gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],acc_x [g],acc_y [g],acc_z [g]\n";
const std::string still = ",0.1,0.2,0.3,0,0,1\n";

TEST(OwnRows, AHeaderThatStandsAgainAndTextAtTheEndAreNoRows) {
  const Folder folder;
  const std::string head =
      "time,gyro_x,gyro_y,gyro_z,acc_x,acc_y,acc_z\n"
      "s,deg/s,deg/s,deg/s,g,g,g\n";
  const std::string path =
      folder.write("r.csv", head + "1" + still + "2" + still + head + "3" + still + head + "4" +
                                still + "End of the recording\nOperator: J. Doe\n");
  const Recording r = read_recording(path, RecordingKind::strapdown, gravity);
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{1.0, 2.0, 3.0, 4.0}));
  const std::vector<std::string> said = r.remarks.texts();
  const auto says = [&](std::string_view part) {
    return std::ranges::any_of(
        said, [&](const std::string& s) { return s.find(part) != std::string::npos; });
  };
  EXPECT_TRUE(says("the header stands again in 2 lines, the last of them 8"));
  EXPECT_TRUE(says("lines 11 to 12, the last, are text: they are left out"));
  EXPECT_FALSE(says("cut off"));
  const std::string between = folder.write("b.csv", head + "1" + still + "a pause\n" + "2" + still);
  EXPECT_THROW(read_recording(between, RecordingKind::strapdown, gravity), InputError)
      << "text between rows is not passed over";
}

TEST(OwnRows, EmptyRowsAndSummariesOfASpreadsheetAreNoRows) {
  const Folder folder;
  const std::string head = "time [s]," + imu_header, empty = ",,,,,,\n";
  const std::string path = folder.write(
      "r.csv", head + "1" + still + empty + "2" + still + "3" + still + empty + "Mean,,,,,,\n");
  const Recording r = read_recording(path, RecordingKind::strapdown, gravity);
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(guess_file(path).rows, 3u);
  EXPECT_TRUE(std::ranges::any_of(r.remarks.texts(), [](const std::string& s) {
    return s.find("line 7, the last, is text: it is left out") != std::string::npos;
  }));
}

TEST(OwnRows, ASummaryWithNumbersBelowTheLastRowIsNone) {
  const Folder folder;
  const std::string rows = "time [s]," + imu_header + "1" + still + "2" + still;
  for (const std::string& summary :
       {std::string("Mean,0.1,0.2,0.3,0,0,1\n"), "Mean,,0.2,0.3,0,0,1\nMax" + still,
        std::string("\nSummary\nrows,2\nmean,0.1\n")}) {
    const Recording r =
        read_recording(folder.write("r.csv", rows + summary), RecordingKind::strapdown, gravity);
    EXPECT_EQ(r.find("time")->values, (std::vector<double>{1.0, 2.0})) << summary;
    EXPECT_TRUE(std::ranges::any_of(r.remarks.texts(), [](const std::string& s) {
      return s.find("left out") != std::string::npos;
    })) << summary;
    EXPECT_THROW(read_recording(folder.write("b.csv", rows + summary + "3" + still),
                                RecordingKind::strapdown, gravity),
                 InputError)
        << "between rows it is not passed over";
  }
}

TEST(OwnRows, AHeaderOfSeveralLinesHasNamesUnitsAndWords) {
  const Folder folder;
  const std::string names = "Time,Accelerometer X,Accelerometer Y,Accelerometer Z\n",
                    units = "[s],[mg],[mg],[mg]\n", words = "CH0,CH1,CH2,CH3\n",
                    rows = "1,0,0,1000\n2,0,0,1000\n";
  for (const std::string& head : {names + units + words, names + words + units}) {
    const GuessedFile file = guess_file(folder.write("own.csv", head + rows));
    std::string text;
    for (const GuessedColumn& c : file.columns) text += c.channel + c.unit + " ";
    EXPECT_EQ(text, "times acc_xmg acc_ymg acc_zmg ") << head;
    EXPECT_EQ(file.rows, 2u) << head;
  }
  const std::string path =
      folder.write("r.csv", std::string("time,gyro_x,gyro_y,gyro_z,acc_x,acc_y,acc_z\n"
                                        "s,deg/s,deg/s,deg/s,g,g,g\n"
                                        "clock,FOG 1,FOG 2,FOG 3,A 1,A 2,A 3\n1") +
                                still + "2" + still);
  const Recording r = read_recording(path, RecordingKind::strapdown, gravity);
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{1.0, 2.0}));
  EXPECT_TRUE(std::ranges::any_of(r.remarks.texts(), [](const std::string& s) {
    return s.find("rows begin below line 3") != std::string::npos;
  }));
}

TEST(OwnRows, ADelimiterAtTheEndOfEveryRowBeginsNoCell) {
  const Folder folder;
  std::string text = "time [s]," + imu_header;
  for (const char* t : {"1", "2", "3"}) text += t + still;
  for (std::size_t at = text.find('\n') + 1; (at = text.find('\n', at)) != std::string::npos;
       at += 2)
    text.insert(at, ",");
  const std::string path = folder.write("r.csv", text);
  const Recording r = read_recording(path, RecordingKind::strapdown, gravity);
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(r.find("acc_z")->values, (std::vector<double>{1.0, 1.0, 1.0}));
  EXPECT_EQ(guess_file(path).rows, 3u);
  const std::string full = folder.write("f.csv", text + "4,0.1,0.2,0.3,0,0,1,7\n");
  EXPECT_THROW(read_recording(full, RecordingKind::strapdown, gravity), InputError)
      << "what stands behind the last delimiter is not left off";
}

TEST(OwnRows, WhatStandsForNotMeasuredIsNotMeasured) {
  const Folder folder;
  const std::string path = folder.write(
      "r.csv",
      "time [s]," + imu_header.substr(0, imu_header.size() - 1) + ",oil [1]\n" +
          "1,0.1,0.2,0.3,0,0,1,7\n2,0.1,0.2,-9999.0,ERR,0,1,-9999\n3,0.1,0.2,0.3,0,0,1,8\n");
  try {
    read_recording(path, RecordingKind::strapdown, gravity);
    FAIL() << "a text was taken for a number";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("missing = [\"ERR\"]"), std::string::npos) << e.what();
  }
  RecordingFormat format;
  format.missing = {"-9999", "ERR"};
  const Recording r = read_recording(path, format, RecordingKind::strapdown, gravity);
  for (const char* name : {"gyro_z", "acc_x", "oil"}) {
    const std::vector<double>& x = r.find(name)->values;
    EXPECT_TRUE(std::isfinite(x[0]) && std::isnan(x[1]) && std::isfinite(x[2])) << name;
  }
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{1.0, 2.0, 3.0}));
}

TEST(OwnRows, BarsMayDivideTheCells) {
  const Folder folder;
  std::string text = "time [s]," + imu_header + "1" + still + "2" + still;
  std::ranges::replace(text, ',', '|');
  const Recording r =
      read_recording(folder.write("r.csv", text), RecordingKind::strapdown, gravity);
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(r.find("acc_z")->values, (std::vector<double>{1.0, 1.0}));
}

TEST(OwnRows, CommasOfTheHeaderDivideNothingWhereTheRowsHaveOthers) {
  const Folder folder;
  const std::string path =
      folder.write("r.csv",
                   "Time, s;Acc X, g;Acc Y, g;Acc Z, g;Gyro X, deg/s;Gyro Y, deg/s;Gyro Z, deg/s\n"
                   "1,5;0;0;1;0,1;0,2;0,3\n2,5;0;0;1;0,1;0,2;0,3\n");
  const GuessedFile file = guess_file(path);
  const Recording r = read_recording(path, file.format, RecordingKind::strapdown, gravity);
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{1.5, 2.5}));
  EXPECT_NEAR(r.find("gyro_z")->values[1], 0.3 * detail::deg, 1e-15);
}

/// What is said of a platform's log with these columns of angles.
std::string said_of_angles(const std::string& header, const std::string& cells) {
  const Folder folder;
  const std::string text = "time [s];position;acc_x [g];acc_y [g];acc_z [g];" + header +
                           "\n1;1;0;0;1;" + cells + "\n2;1;0;0;1;" + cells + "\n";
  const std::string path = folder.write("own.csv", text);
  try {
    read_recording(path, guess_file(path).format, RecordingKind::platform, gravity);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(OwnRows, AnglesInThreeColumnsAreRefusedWithWhatToWrite) {
  for (const std::string names : {"outer deg;outer min;outer sec", "outer_deg;outer_min;outer_sec",
                                  "outer [deg];outer [arcmin];outer [arcsec]"}) {
    const std::string said = said_of_angles(names, "-89;57;40.7");
    EXPECT_NE(said.find("angles in degrees, minutes and seconds"), std::string::npos) << said;
    EXPECT_NE(said.find("Write them in decimal degrees"), std::string::npos) << said;
  }
  EXPECT_EQ(said_of_angles("T deg;T min;T max", "1;2;3"), "")
      << "least and most are no parts of it";
  const std::string names = "gimbal_outer [deg];gimbal_middle [deg];gimbal_inner [deg]";
  EXPECT_NE(said_of_angles(names, "1 234.5;1;2").find("marks between thousands"),
            std::string::npos);
}

TEST(OwnRows, AnglesInDegreesMinutesAndSecondsAreRead) {
  const Folder folder;
  for (const std::string unit : {" [deg]", "", " [dms]"})
    for (const std::string cell : {"-89\u00B057'40.7''", "-89:57:40.7", "-89 57 40,7"}) {
      const std::string text = fmt::format(
          "time [s];position;acc_x [g];acc_y [g];acc_z [g];gimbal_outer{0};"
          "gimbal_middle{0};gimbal_inner{0}\n1;1;0;0;1;{1};{1};{1}\n2;1;0;0;1;{1};"
          "{1};\n",
          unit, cell);
      const std::string path = folder.write("own.csv", text);
      const Recording r =
          read_recording(path, guess_file(path).format, RecordingKind::platform, gravity);
      EXPECT_NEAR(r.find("gimbal_outer")->values[1] / detail::deg,
                  -(89.0 + 57.0 / 60.0 + 40.7 / 3600.0), 1e-10)
          << text;
      EXPECT_TRUE(std::isnan(r.find("gimbal_inner")->values[1]));
    }
  const std::string said = said_of_angles(
      "gimbal_outer [rad];gimbal_middle [rad];gimbal_inner [rad]", "-89:57:40.7;0;0");
  EXPECT_NE(said.find("found '-89:57:40.7'"), std::string::npos) << said;
}

/// What is said to be 45.3015 is converted once: an angle with marks beside it would be, twice.
TEST(OwnRows, AnglesWithMarksAreNoneWhereTheirDigitsAreSaidToBeMinutesAndSeconds) {
  const Folder folder;
  const std::string path =
      folder.write("own.csv",
                   "time [s],position,gimbal_outer [deg],gimbal_middle [deg],gimbal_inner [deg]\n"
                   "1,1,45.3015,0,0\n2,1,45:30:15,0,0\n3,1,45.3015,0,0\n");
  try {
    read_recording(path, {.angles = AngleDigits::minutes_and_seconds}, RecordingKind::platform,
                   gravity);
    ADD_FAILURE() << "read";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("found '45:30:15'"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace drift::own_rows_test
