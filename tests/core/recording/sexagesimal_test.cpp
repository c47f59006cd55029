// Gimbal angles as degrees, minutes and seconds in one number.
#include "core/recording/sexagesimal.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

TEST(MinutesAndSeconds, OfARecordingAreRefused) {
  const Folder folder;
  const auto read = [&](bool written_so) {
    std::string text =
        "time [s],position,gimbal_outer [deg],gimbal_middle [deg],gimbal_inner [deg]\n";
    const std::vector<double> outer = drifting(-90.2, 60.0, 120), inner = drifting(0.4, 21.0, 120);
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const auto cell = [&](double x) { return written_so ? as_minutes_and_seconds(x) : x; };
      text += fmt::format("{},1,{:.4f},0,{:.4f}\n", 60 * (k + 1), cell(outer[k]), cell(inner[k]));
    }
    try {
      read_recording(folder.write("r.csv", text), RecordingKind::platform, gravity);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(read(false), "");
  EXPECT_NE(read(true).find("degrees, minutes and seconds in one number: in none of 360"),
            std::string::npos)
      << read(true);
}

}  // namespace
}  // namespace drift::sexagesimal_test
