// Logs with the date in one column and the time of day in another.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/recording/own/guess.hpp"
#include "recording_fixture.hpp"

namespace drift::date_and_clock_test {
namespace {

using namespace test;

const std::string acc_header = ";ax [g];ay [g];az [g]\n", level = ";0;0;1\n";
const std::string imu_header =
    ";gyro_x [deg/s];gyro_y [deg/s];gyro_z [deg/s];acc_x [g];acc_y [g];acc_z [g]\n";
const std::string still = ";0.1;0.2;0.3;0;0;1\n";

/// The channels of the columns, and the one of the dates behind a @.
std::string columns(const GuessedFile& file) {
  std::string text;
  for (const GuessedColumn& c : file.columns) text += (c.channel.empty() ? "-" : c.channel) + " ";
  return text + "@" + file.format.date;
}

TEST(DateAndClock, ADateIsThatOfTheTimeAndNoPosition) {
  const Folder folder;
  const auto guess = [&](const std::string& header, const std::string& first,
                         const std::string& second) {
    return guess_file(
        folder.write("own.csv", header + acc_header + first + level + second + level));
  };
  const GuessedFile named = guess("Datum;Uhrzeit", "14.03.2026;23:59:58", "15.03.2026;00:00:00");
  EXPECT_EQ(columns(named), "- time acc_x acc_y acc_z @Datum");
  EXPECT_NE(recording_section(named).find("date = \"Datum\"\n"), std::string::npos)
      << recording_section(named);
  EXPECT_EQ(columns(guess("date;clock", "2026-03-14;23:59:58", "2026-03-15;00:00:00")),
            "- time acc_x acc_y acc_z @date");
  EXPECT_EQ(columns(guess("D;C", "12/31/2026;11:59:58 PM", "01/01/2027;12:00:00 AM")),
            "- time acc_x acc_y acc_z @D");
  // The day on which the file was begun says nothing of the rows past midnight.
  EXPECT_EQ(columns(guess("Datum;Uhrzeit", "14.03.2026;23:59:58", "14.03.2026;00:00:00")),
            "- time acc_x acc_y acc_z @");
  EXPECT_EQ(columns(guess("Datum;t [s]", "14.03.2026;1", "15.03.2026;2")),
            "- time acc_x acc_y acc_z @")
      << "nor is it a position beside other times";
}

TEST(DateAndClock, TheProgramsOwnNamesNeedTheDateSaid) {
  const Folder folder;
  const auto needs = [&](const std::string& second) {
    return needs_section(guess_file(
        folder.write("own.csv", "date;time;acc_x [g];acc_y [g];acc_z [g]\n2026-03-14;23:59:58" +
                                    level + second + ";00:00:00" + level)));
  };
  EXPECT_TRUE(needs("2026-03-15"));
  EXPECT_FALSE(needs("2026-03-14"));
}

TEST(DateAndClock, AreReadAsOneTime) {
  const Folder folder;
  const std::string path =
      folder.write("imu.csv", "Datum;Uhrzeit" + imu_header + "14.03.2026;23:59:58" + still +
                                  "15.03.2026;00:00:00" + still + "16.03.2026;00:00:02" + still);
  const GuessedFile file = guess_file(path);
  const Recording r = read_recording(path, file.format, RecordingKind::strapdown, gravity);
  // A day and two seconds after the second row: the times of day alone say two seconds.
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{0.0, 2.0, 86404.0}));
  EXPECT_EQ(r.facts.back(),
            (std::pair<std::string, std::string>{"time_zero", "14.03.2026 23:59:58"}));
  EXPECT_EQ(r.find("Datum"), nullptr);
}

TEST(DateAndClock, DatesAreNumbersToo) {
  const Folder folder;
  const auto guess = [&](const std::string& rows) {
    return columns(guess_file(folder.write("own.csv", "Date;Time" + acc_header + rows)));
  };
  EXPECT_EQ(guess("20260314;23:59:58" + level + "20260315;00:00:00" + level),
            "- time acc_x acc_y acc_z @Date");
  EXPECT_EQ(guess("20269914;23:59:58" + level + "20269915;00:00:00" + level),
            "- time acc_x acc_y acc_z @")
      << "no date";
  std::string basic, seconds;
  for (int second = 50; second < 60; ++second)
    basic += fmt::format("20260314;2359{}{}", second, level);
  EXPECT_EQ(guess(basic), "- time acc_x acc_y acc_z @Date");
  for (int second = 55; second < 65; ++second)
    seconds += fmt::format("20260314;2359{}{}", second, level);
  EXPECT_EQ(guess(seconds), "- time acc_x acc_y acc_z @") << "235961 is no time of day";
  const GuessedFile file = guess_file(folder.write("own.csv", "Date;Time" + acc_header + basic));
  EXPECT_TRUE(file.columns[1].unit.empty()) << "times of a clock have none";
}

/// Seconds since the first of rows with a date and a time each, as the guessed section reads them.
std::vector<double> times(const std::vector<std::string>& rows, std::string& remarks) {
  const Folder folder;
  std::string text = "Datum;Uhrzeit" + imu_header;
  for (const std::string& row : rows) text += row + still;
  const std::string path = folder.write("imu.csv", text);
  const Recording r =
      read_recording(path, guess_file(path).format, RecordingKind::strapdown, gravity);
  remarks = testing::PrintToString(r.remarks.texts());
  return r.find("time")->values;
}

TEST(DateAndClock, ADateMayStandWhereItChangesAlone) {
  std::string remarks;
  EXPECT_EQ(
      times({"14.03.2026;23:59:58", ";23:59:59", "15.03.2026;00:00:00", ";00:00:01"}, remarks),
      (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
  EXPECT_NE(remarks.find("2 rows, from line 3 on, without a date"), std::string::npos) << remarks;
}

TEST(DateAndClock, ADateThatChangesLateIsThatOfTheNextDay) {
  std::string remarks;
  EXPECT_EQ(times({"14.03.2026;23:59:58", "14.03.2026;00:00:00", "14.03.2026;00:00:02",
                   "15.03.2026;00:00:04"},
                  remarks),
            (std::vector<double>{0.0, 2.0, 4.0, 6.0}));
  EXPECT_NE(remarks.find("2 dates are of the day before behind midnight"), std::string::npos)
      << remarks;
  // After a pause of days, too, once a midnight has passed as it should.
  EXPECT_EQ(times({"13.03.2026;23:59:58", "16.03.2026;23:59:58", "17.03.2026;00:00:00",
                   "17.03.2026;23:59:58", "17.03.2026;00:00:00", "18.03.2026;00:00:02"},
                  remarks),
            (std::vector<double>{0.0, 259200.0, 259202.0, 345600.0, 345602.0, 345604.0}));
}

TEST(DateAndClock, ADateThatChangesEarlyIsRefused) {
  std::string remarks;
  try {
    times({"14.03.2026;23:59:56", "15.03.2026;23:59:58", "15.03.2026;00:00:00"}, remarks);
    FAIL() << "read";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("4:time: 15.03.2026 00:00:00 comes before"),
              std::string::npos)
        << e.what();
    EXPECT_NE(std::string(e.what()).find("leave recording.date out"), std::string::npos)
        << e.what();
  }
}

std::string refused(const std::string& date, const std::string& time) {
  const Folder folder;
  RecordingFormat format;
  format.date = "Datum";
  format.columns.push_back({"time", "Uhr", {}, 1.0});
  const std::string path = folder.write("imu.csv", "Datum;Uhr" + imu_header + date + ";" + time +
                                                       still + "15.03.2026;00:00:00" + still);
  try {
    read_recording(path, format, RecordingKind::strapdown, gravity);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(DateAndClock, WhatIsNeitherIsRefusedWithItsCell) {
  EXPECT_EQ(refused("14.03.2026", "23:59:58"), "");
  EXPECT_EQ(refused("20260314", "235958"), "");
  EXPECT_EQ(refused("2026-03-14", "23:59:58Z"), "");
  EXPECT_NE(refused("14.13.2026", "23:59:58").find("2:Datum: found '14.13.2026'"),
            std::string::npos)
      << refused("14.13.2026", "23:59:58");
  EXPECT_NE(refused("14.03.2026", "86398").find("a time of day such as"), std::string::npos)
      << refused("14.03.2026", "86398");
}

TEST(DateAndClock, ColumnsOfNumbersHoldNoDates) {
  const Folder folder;
  write_recording(platform_recording(), folder / "r.h5");
  RecordingFormat format;
  format.date = "wobble";
  try {
    read_recording(folder / "r.h5", format, RecordingKind::platform, gravity);
    FAIL() << "read";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("recording.date"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace drift::date_and_clock_test
