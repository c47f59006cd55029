// Readings brought to other instants by the smooth course that they themselves show.
#include "core/recording/instants/shifted_readings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/recording/recording_channels.hpp"

namespace drift::shifted_readings_test {
namespace {

constexpr double rate = detail::earth_rate;

/// An hour of one position in rows of 10 s: gravity along x of a platform that turns with the
/// Earth, and a gimbal that turns as much through a whole turn.
Recording turning() {
  Recording r;
  r.channels = {{"time", unit::s, {}},
                {"position", unit::one, {}},
                {"acc_x", unit::g, {}},
                {"gimbal_inner", unit::deg, {}}};
  for (int k = 1; k <= 360; ++k) {
    const double t = 10.0 * k;
    r.channels[0].values.push_back(t);
    r.channels[1].values.push_back(1.0);
    r.channels[2].values.push_back(std::sin(rate * t));
    r.channels[3].values.push_back(std::remainder(3.0 + rate * t, 360.0 * detail::deg));
    r.lines.push_back(static_cast<std::size_t>(k) + 1);
  }
  return r;
}

TEST(ShiftedReadings, AreWhatTheCourseHadThen) {
  Recording r = turning();
  shift_readings(r, accelerometer_channels.names, -5.0);
  shift_readings(r, gimbal_channels.names, 2.0);
  for (std::size_t k = 0; k < r.rows(); ++k) {
    const double t = r.channels[0].values[k];
    // An hour is 0.26 rad; of a sine about its middle a polynomial of fourth degree leaves
    // 0.13^5 / 120 / 16 = 2e-8, and at its ends a part of that changes in 5 s of 1800: 25 * 5 /
    // 1800.
    EXPECT_NEAR(r.channels[2].values[k], std::sin(rate * (t - 5.0)), 2e-9);
    EXPECT_NEAR(
        std::remainder(r.channels[3].values[k] - 3.0 - rate * (t + 2.0), 360.0 * detail::deg), 0.0,
        1e-12);
  }
}

TEST(ShiftedReadings, KeepWhatIsNotReadAndDoNotFollowASpike) {
  Recording r = turning();
  r.channels[2].values[100] = nan_value;
  r.channels[2].values[200] = 5.0;
  shift_readings(r, accelerometer_channels.names, -5.0);
  EXPECT_TRUE(std::isnan(r.channels[2].values[100]));
  const double t = r.channels[0].values[210];
  EXPECT_NEAR(r.channels[2].values[210], std::sin(rate * (t - 5.0)), 2e-9);
}

TEST(ShiftedReadings, TheNoiseOfARowStaysItsOwn) {
  Recording r = turning();
  const double before = r.channels[2].values[180];
  r.channels[2].values[180] += 1e-5;
  shift_readings(r, accelerometer_channels.names, -5.0);
  // One row of 360 moves its course by a few of 1e-5 / 360.
  EXPECT_NEAR(r.channels[2].values[180] - before, 1e-5 - 5.0 * rate * std::cos(rate * 1810.0),
              1e-7);
}

TEST(ShiftedReadings, AreTakenAsTheStudySays) {
  Recording momentary = turning(), late = turning(), mean = turning();
  take_instants(mean, {});
  EXPECT_EQ(mean.channels[2].values, turning().channels[2].values);
  RecordingFormat format;
  format.accelerometers = AccelerometerReading::momentary;
  take_instants(momentary, format);
  format.accelerometers = AccelerometerReading::mean;
  format.accelerometers_late = -5.0;
  take_instants(late, format);
  EXPECT_EQ(momentary.channels[2].values, late.channels[2].values);
  EXPECT_NEAR(late.channels[2].values[9], std::sin(rate * 95.0), 2e-9);
  EXPECT_EQ(late.channels[3].values, mean.channels[3].values);
}

}  // namespace
}  // namespace drift::shifted_readings_test
