// Gimbal angles as degrees, minutes and seconds, in a text or in one number.
#include "core/recording/sexagesimal.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/recording/own/guess.hpp"
#include "recording_fixture.hpp"

namespace drift::sexagesimal_test {
namespace {

using namespace test;

/// 45.50417 deg as 45.3015.
double as_minutes_and_seconds(double degrees) {
  const double seconds = std::round(3600.0 * std::abs(degrees));
  const double minutes = std::floor(seconds / 60.0), whole = std::floor(minutes / 60.0);
  return std::copysign(whole + 1e-2 * (minutes - 60.0 * whole) + 1e-4 * (seconds - 60.0 * minutes),
                       degrees);
}

/// An angle that drifts as the Earth turns, read every `step` seconds to so many degrees.
std::vector<double> drifting(double from, double step, int rows, double to = 0.0) {
  std::vector<double> all;
  for (int k = 0; k < rows; ++k) {
    const double x = from + step * k * 15.04 / 3600.0;
    all.push_back(to > 0.0 ? to * std::round(x / to) : x);
  }
  return all;
}

double chance_of(const std::vector<double>& degrees, bool written_so) {
  std::vector<double> column = degrees;
  if (written_so)
    for (double& x : column) x = as_minutes_and_seconds(x);
  MinutesAndSeconds angles;
  angles.look_at(column);
  return angles.chance();
}

TEST(MinutesAndSeconds, AreToldByWhatIsNotThere) {
  for (const double from : {-93.0, -0.2, 179.3})
    for (const double step : {0.1, 1.0, 30.0, 60.0}) {
      EXPECT_LT(chance_of(drifting(from, step, 600), true), 6e-7) << from << " " << step;
      EXPECT_EQ(chance_of(drifting(from, step, 600), false), 1.0) << from << " " << step;
    }
}

/// What few angles, a coarse readout and steps of hundredths leave out, they leave out in decimals.
TEST(MinutesAndSeconds, AreNotToldOfFewValues) {
  const auto may_be = [](const std::vector<double>& x) { return !(chance_of(x, false) < 6e-7); };
  EXPECT_TRUE(may_be(drifting(20.0, 60.0, 12)));
  for (const double to : {0.5, 0.1, 0.05, 0.02, 0.01, 0.005, 0.001})
    EXPECT_TRUE(may_be(drifting(20.0, 60.0, 600, to))) << to;
  EXPECT_TRUE(may_be(std::vector<double>(600, 20.3015)));
  std::vector<double> held;  // in twelve positions, each for a while
  for (int k = 0; k < 600; ++k) held.push_back(30.0 * (k / 50) + 0.3015 + 1e-4 * (k * 7 % 13));
  EXPECT_TRUE(may_be(held));
}

/// Of columns that stand at random places the chance is no less than that of it.
TEST(MinutesAndSeconds, TheChanceHolds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-180.0, 180.0);
  int below = 0;
  constexpr int columns = 200000;
  for (int k = 0; k < columns; ++k) {
    std::vector<double> few;
    for (int i = 0; i < 5; ++i) few.push_back(angle(random));
    below += chance_of(few, false) < 0.1 ? 1 : 0;
  }
  EXPECT_GT(below, 0);
  EXPECT_LT(below, 0.1 * columns);
}

TEST(MinutesAndSeconds, OfATextAreAnAngle) {
  const double angle = -(89.0 + 57.0 / 60.0 + 40.7 / 3600.0);
  for (const std::string text :
       {"-89\u00B057'40.7\"", "-89\u00B0 57' 40.7''", "-89\u00B057\u203240.7\u2033", "-89:57:40.7",
        "-89 57 40.7", "-89:57:40,7", "-89\u00B057.6783333333333'"})
    EXPECT_NEAR(angle_in_minutes_and_seconds(text).value_or(0.0), angle, 1e-11) << text;
  EXPECT_NEAR(*angle_in_minutes_and_seconds("-0\u00B030'"), -0.5, 1e-15) << "the sign of no degree";
  EXPECT_EQ(angle_in_minutes_and_seconds("45.5\u00B0"), 45.5);
  for (const std::string text : {"1 234.5", "12:30", "45:60:00", "45:00:60", "45.5:30:00",
                                 "1:2:3:4", "45:30.5:10", "45:30:x", "x\u00B0", "", "45"})
    EXPECT_FALSE(angle_in_minutes_and_seconds(text)) << text;
}

/// Every second of two degrees, and what is none.
TEST(MinutesAndSeconds, OfANumberAreAnAngle) {
  for (int seconds = -3600; seconds <= 3600; ++seconds)
    for (const double degrees : {0.0, 359.0}) {
      const double angle = degrees + std::abs(seconds) / 3600.0;
      const double written = std::stod(fmt::format("{:.4f}", as_minutes_and_seconds(angle)));
      const double sign = seconds < 0 ? -1.0 : 1.0;
      ASSERT_NEAR(angle_from_minutes_and_seconds(sign * written), sign * angle, 1e-12) << written;
    }
  EXPECT_NEAR(angle_from_minutes_and_seconds(45.30152), 45.5 + 15.2 / 3600.0, 1e-12);
  for (const double none : {45.60, 45.9999, -0.0060, 12.3460})
    EXPECT_TRUE(std::isnan(angle_from_minutes_and_seconds(none))) << none;
}

/// A platform in free drift, its angles to four decimals; what is said, and the angles read [deg].
struct ReadAngles {
  std::string said;
  std::vector<double> outer;
};

ReadAngles read_angles(const std::string& path, const RecordingFormat& format) {
  ReadAngles out;
  try {
    const Recording r = read_recording(path, format, RecordingKind::platform, gravity);
    for (const double x : r.find("gimbal_outer")->values) out.outer.push_back(x / unit::deg.to_si);
  } catch (const InputError& e) {
    out.said = e.what();
  }
  return out;
}

std::string log_of_angles(bool written_so, const std::vector<double>& outer) {
  std::string text =
      "time [s],position,gimbal_outer [deg],gimbal_middle [deg],gimbal_inner [deg]\n";
  const std::vector<double> inner = drifting(0.4, 21.0, static_cast<int>(outer.size()));
  for (std::size_t k = 0; k < outer.size(); ++k) {
    const auto cell = [&](double x) { return written_so ? as_minutes_and_seconds(x) : x; };
    text += fmt::format("{},1,{:.4f},0,{:.4f}\n", 60 * (k + 1), cell(outer[k]), cell(inner[k]));
  }
  return text;
}

TEST(MinutesAndSeconds, OfARecordingAreRefusedUntilItIsSaidWhatTheyAre) {
  const Folder folder;
  const std::vector<double> outer = drifting(-90.2, 60.0, 120, 1.0 / 3600.0);
  const std::string decimal = folder.write("decimal.csv", log_of_angles(false, outer)),
                    sixty = folder.write("sixty.csv", log_of_angles(true, outer));
  EXPECT_EQ(read_angles(decimal, {}).said, "");
  const std::string said = read_angles(sixty, {}).said;
  EXPECT_NE(said.find("degrees, minutes and seconds in one number: in none of 360"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("angles = \"dd.mmss\""), std::string::npos) << said;
  const std::vector<double> read =
      read_angles(sixty, {.angles = AngleDigits::minutes_and_seconds}).outer;
  ASSERT_EQ(read.size(), outer.size());
  for (std::size_t k = 0; k < outer.size(); ++k) EXPECT_NEAR(read[k], outer[k], 1e-10);
  const std::vector<double> as_they_stand =
      read_angles(sixty, {.angles = AngleDigits::decimal}).outer;
  ASSERT_EQ(as_they_stand.size(), outer.size());
  EXPECT_NEAR(as_they_stand.front(), -90.12, 1e-10);
  const std::string wrong = read_angles(decimal, {.angles = AngleDigits::minutes_and_seconds}).said;
  EXPECT_NE(wrong.find("has 60 minutes or seconds, or more"), std::string::npos) << wrong;
}

TEST(MinutesAndSeconds, OfARecordingAreProposedToBeReadSo) {
  const Folder folder;
  const std::vector<double> outer = drifting(-90.2, 60.0, 120, 1.0 / 3600.0);
  for (const bool so : {false, true}) {
    const GuessedFile file = guess_file(folder.write("own.csv", log_of_angles(so, outer)));
    EXPECT_EQ(file.format.angles, so ? AngleDigits::minutes_and_seconds : AngleDigits::automatic);
    EXPECT_EQ(recording_section(file).find("angles  = \"dd.mmss\"") != std::string::npos, so)
        << recording_section(file);
  }
}

}  // namespace
}  // namespace drift::sexagesimal_test
