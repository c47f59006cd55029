// Times of a clock, and numbers that a user's program wrote in its own way.
#include "core/recording/own/clock.hpp"

#include <gtest/gtest.h>

#include "recording_fixture.hpp"

namespace drift::clock_test {
namespace {

using namespace test;

const std::string imu_header =
    "gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],acc_x [g],acc_y [g],acc_z [g]\n";
const std::string still = ",0.1,0.2,0.3,0,0,1\n";

TEST(Clock, ClocksAreSecondsAndNothingElseIs) {
  EXPECT_EQ(parse_clock("1970-01-02T00:00:01.5Z"), 86401.5);
  EXPECT_EQ(parse_clock("1970-01-02 01:00:01,5+01:00"), 86401.5);
  EXPECT_EQ(parse_clock("02.01.1970 00:00:01"), 86401.0);
  EXPECT_EQ(parse_clock("02/01/1970 00:00:01"), 86401.0);
  for (const char* named : {"02-Jan-1970 00:00:01", "2 JAN 1970 00:00:01",
                            "02. January 1970 00:00:01", "02/jan/1970 00:00:01"})
    EXPECT_EQ(parse_clock(named), 86401.0) << named;
  EXPECT_EQ(parse_clock("02-Mai-1970 00:00:00"), parse_clock("1970-05-02 00:00:00"));
  for (const char* none :
       {"02-Jab-1970 00:00:01", "32-Jan-1970 00:00:01", "02 Jan 70 00:00:01", "2 Jan"})
    EXPECT_FALSE(parse_clock(none)) << none;
  EXPECT_EQ(parse_clock("01/02/1970 00:00:01", StrokeDates::month_first), 86401.0);
  EXPECT_EQ(parse_clock("1970/01/02 00:00:01", StrokeDates::month_first), 86401.0);
  EXPECT_EQ(parse_clock("13:05:10.25"), 47110.25);
  EXPECT_EQ(parse_clock("13:05"), 47100.0);
  EXPECT_EQ(parse_clock("01:05 PM"), 47100.0);
  EXPECT_EQ(parse_clock("13.05.10"), 47110.0);
  EXPECT_EQ(parse_clock("13.05.10,25"), 47110.25);
  EXPECT_EQ(parse_clock("02.01.1970 00.00.01"), 86401.0);
  EXPECT_EQ(parse_clock("02.01.1970 00:01"), 86460.0);
  EXPECT_EQ(parse_clock("01:05:10.25 PM"), 47110.25);
  EXPECT_EQ(parse_clock("1970-01-02 12:00:01 am"), 86401.0);
  EXPECT_EQ(parse_clock("24:00:00"), 86400.0);
  EXPECT_EQ(parse_clock("1970-01-01T24:00:00Z"), parse_clock("1970-01-02T00:00:00Z"));
  EXPECT_EQ(parse_clock("01:05:10Z"), 3910.0);
  EXPECT_EQ(parse_clock("01:05:10+01:00"), 310.0);
  EXPECT_EQ(parse_clock("19700102T000001Z"), 86401.0);
  EXPECT_EQ(parse_clock("19700102 010001.5+01"), 86401.5);
  EXPECT_EQ(parse_clock("1970-01-02T000001"), 86401.0);
  for (const char* none : {"08:30-09:00", "19700102", "19701302T000001", "19700102T240000",
                           "19700102T0001", "12345678 000001"})
    EXPECT_FALSE(parse_clock(none)) << none;
  for (const char* text :
       {"2026-02-30T00:00:00", "25:00:00", "24:00:01", "24:01:00", "13:", "13:60",
        "31/31/2026 00:00:00", "", "2026-03-01", "12:00:00x", "13.05", "1.234.567", "13.05:10",
        "13:05.10", "13:00:00 PM", "2026-03-01T12:00:00+99"})
    EXPECT_FALSE(parse_clock(text)) << text;
}

TEST(Clock, TimesOfDayGoOnPastMidnight) {
  const Folder folder;
  const std::string path = folder.write("imu.csv", "time," + imu_header + "23:59:59.5" + still +
                                                       "23:59:59.75" + still + "00:00:00" + still);
  const Recording r = read_recording(path, RecordingKind::strapdown, gravity);
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{0.0, 0.25, 0.5}));
  EXPECT_EQ(r.facts.back(), (std::pair<std::string, std::string>{"time_zero", "23:59:59.5"}));
  const std::string end = folder.write("end.csv", "time," + imu_header + "23:59:59.75" + still +
                                                      "24:00:00" + still + "00:00:00.25" + still);
  EXPECT_EQ(read_recording(end, RecordingKind::strapdown, gravity).find("time")->values,
            (std::vector<double>{0.0, 0.25, 0.5}));
}

/// A date that is late where minutes are all that is written: the time goes back by a day.
TEST(Clock, MinutesOfADateThatIsLateMayBeOneMinute) {
  Clock clock(true);
  std::vector<double> times;
  for (const char* cell : {"14.03.2026 23:59", "14.03.2026 00:00", "14.03.2026 00:00",
                           "14.03.2026 00:01", "15.03.2026 00:02"})
    times.push_back(clock.read(cell).value());
  EXPECT_EQ(times, (std::vector<double>{0.0, 60.0, 60.0, 120.0, 180.0}));
  EXPECT_EQ(clock.late_dates(), 3u);
}

TEST(Clock, OneOClockAfterTwelveIsThatOfAClockOfTwelveHours) {
  const Folder folder;
  const auto said = [&](const std::string& first, const std::string& second) {
    const std::string path =
        folder.write("imu.csv", "time," + imu_header + first + still + second + still);
    try {
      read_recording(path, RecordingKind::strapdown, gravity);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  for (const auto& [first, second] : {std::pair{"12:59:58", "01:00:00"}, {"12:40", "1:20"}})
    EXPECT_NE(said(first, second).find("clock of 12 hours, at one o'clock: write AM or PM"),
              std::string::npos)
        << said(first, second);
  const std::string minutes = said(std::string("12:59") + still + "12:59", "01:00");
  EXPECT_NE(minutes.find("4:time: -43140 s comes after 0 s at 3"), std::string::npos) << minutes;
  EXPECT_EQ(minutes.find("repeats"), std::string::npos) << "no more is to be said";
  EXPECT_EQ(said("13:59:58", "02:00:00").find("of 12 hours"), std::string::npos);
  EXPECT_EQ(said("12:59:58 PM", "01:00:00 PM"), "");
}

/// What Clock makes of a column of times.
std::vector<double> seconds(Clock& clock, const std::vector<std::string>& cells) {
  std::vector<double> all;
  for (const std::string& cell : cells) all.push_back(clock.read(cell).value_or(-1.0));
  return all;
}

TEST(Clock, TheChangeOfTheDateTellsWhetherDayOrMonthIsFirst) {
  const std::vector<double> expected = {0.0, 2.0, 4.0};
  Clock day, month, certain;
  EXPECT_EQ(seconds(day, {"03/04/2026 23:59:57", "03/04/2026 23:59:59", "04/04/2026 00:00:01"}),
            expected);
  EXPECT_NE(day.remark().find("the day first"), std::string::npos) << day.remark();
  EXPECT_EQ(day.zero(), "03/04/2026 23:59:57");
  EXPECT_EQ(seconds(month, {"03/04/2026 23:59:57", "03/04/2026 23:59:59", "03/05/2026 00:00:01"}),
            expected);
  EXPECT_NE(month.remark().find("the month first"), std::string::npos) << month.remark();
  EXPECT_EQ(seconds(certain, {"12/31/2026 23:59:57", "12/31/2026 23:59:59", "01/01/2027 00:00:01"}),
            expected);
  EXPECT_EQ(certain.remark(), "");  // there is no month 31
  Clock same;
  EXPECT_EQ(seconds(same, {"03/04/2026 10:00:00", "03/04/2026 10:00:02"}),
            (std::vector<double>{0.0, 2.0}));
  EXPECT_EQ(same.remark(), "");  // it makes no difference
  Clock dashes;
  EXPECT_EQ(seconds(dashes, {"03-04-2026 23:59:57", "03-04-2026 23:59:59", "03-05-2026 00:00:01"}),
            expected);
}

/// What is said of a strapdown recording with these times and first accelerometer readings.
std::string refused(const std::string& time_header, const std::vector<std::string>& times,
                    const std::string& acc_x = "0") {
  const Folder folder;
  std::string text = time_header +
                     ";gyro_x [deg/s];gyro_y [deg/s];gyro_z [deg/s];acc_x [g];acc_y "
                     "[g];acc_z [g]\n";
  for (const std::string& time : times) text += time + ";0.1;0.2;0.3;" + acc_x + ";0;1\n";
  try {
    read_recording(folder.write("own.csv", text), RecordingKind::strapdown, gravity);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Clock, ACountOfMillisecondsThatBeginsAgainAtMidnightIsACounterToSay) {
  const std::string said = refused("time [ms]", {"86399990", "86399995", "0", "5", "10"});
  EXPECT_EQ(said.find("out of order"), std::string::npos) << said;  // said once
  EXPECT_NE(said.find("wrap = 86400000"), std::string::npos) << said;
  EXPECT_EQ(refused("time [ms]", {"100", "200", "0", "5"}).find("wrap"), std::string::npos);
  const std::string week = refused("time [ms]", {"604799990", "604799995", "0", "5", "10"});
  EXPECT_NE(week.find("begins again with the week"), std::string::npos) << week;
  EXPECT_NE(week.find("wrap = 604800000"), std::string::npos) << week;
  // Sorting would scramble a log whose clock begins again: that is said first.
  EXPECT_LT(refused("time [ms]", {"100", "200", "0", "5"}).find("a clock begins again"),
            refused("time [ms]", {"100", "200", "0", "5"}).find("out of order"));
  EXPECT_NE(refused("time [ms]", {"100", "100", "200"}).find("Remove rows"), std::string::npos);
}

TEST(Clock, MarksBetweenThousandsAreNamed) {
  for (const std::string number : {"1,234.5", "1.234,5", "1'234.5", "1 234.5", "1\u00A0234.5"}) {
    const std::string said = refused("time [s]", {"1", "2", "3"}, number);
    EXPECT_NE(said.find("without marks between thousands"), std::string::npos) << said;
  }
  const std::string other = refused("time [s]", {"1", "2", "3"}, "12x");
  EXPECT_EQ(other.find("thousands"), std::string::npos) << other;
  EXPECT_NE(other.find("a number, nan or an empty cell"), std::string::npos) << other;
}

}  // namespace
}  // namespace drift::clock_test
