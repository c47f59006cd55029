// The recipes of core/docs/recording.md, each as it stands there, on a made-up file of the shape it
// is for: the same motion behind all six.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/base/check.hpp"
#include "core/recording/recording.hpp"
#include "core/recording/recording_format.hpp"
#include "mc/study/study.hpp"
#include "tests/support/program.hpp"

namespace drift::recipes_test {
namespace {

constexpr double gravity = 9.81;  // [m/s^2]
constexpr int rows = 400;

/// What the sensors show in sample k: rates [rad/s] and specific force [g].
double gyro(int axis, int k) {
  return 0.3 * std::sin(0.05 * k + axis) + 0.01 * axis;
}
double force(int axis, int k) {
  return (axis == 2 ? 0.97 : 0.1 * axis - 0.2) + 0.02 * std::cos(0.03 * k - axis);
}

/// The indented block below the heading that begins so.
std::string recipe(const std::string& name) {
  const std::string text = test::text_of(std::string(DRIFT_SOURCE_DIR) + "/core/docs/recording.md");
  const auto heading = text.find("\n### " + name);
  if (heading == std::string::npos) return "";
  std::istringstream lines(text.substr(text.find("    [recording]", heading)));
  std::string out;
  for (std::string line; std::getline(lines, line) && line.starts_with("    ");)
    out += line.substr(4) + "\n";
  return out;
}

struct Shape {
  std::string file;       ///< its text
  double interval;        ///< [s]
  double gyro_rounding;   ///< [rad/s]
  double force_rounding;  ///< [g]
};

std::string three(const char* format, auto&& value, const char* between) {
  std::string out;
  for (int axis = 0; axis < 3; ++axis)
    out += (axis > 0 ? between : "") + fmt::format(fmt::runtime(format), value(axis));
  return out;
}

Shape xsens() {
  Shape s{
      "// Start Time: Unknown\n// Update Rate: 100.0Hz\n// Filter Profile: general (51.1)\n"
      "PacketCounter\tSampleTimeFine\tAcc_X\tAcc_Y\tAcc_Z\tGyr_X\tGyr_Y\tGyr_Z\tMag_X\n",
      0.01, 1e-8, 1e-8};
  for (int k = 0; k < rows; ++k)  // the counter begins again half way
    s.file +=
        fmt::format("{:05}\t{}\t{}\t{}\t{:.6f}\n", 65400 + k,
                    (4294967296ull - 20000ull + 100ull * static_cast<unsigned>(k)) % 4294967296ull,
                    three(
                        "{:.8f}", [&](int i) { return gravity * force(i, k); }, "\t"),
                    three(
                        "{:.9f}", [&](int i) { return gyro(i, k); }, "\t"),
                    0.4);
  return s;
}

/// Counts of increments since the row before; what rounding leaves is carried on, as an IMU does.
Shape novatel() {
  const double dv = 6.103515625e-05, da = 1.9073486328125e-06, dt = 0.01;  // LN-200
  Shape s{"", dt, 1.01 * da / dt, 1.01 * dv / dt / gravity};
  double angle[3] = {}, velocity[3] = {};
  for (int k = 0; k < rows; ++k) {
    long long a[3], v[3];
    for (int i = 0; i < 3; ++i) {
      a[i] = std::llround((angle[i] + gyro(i, k) * dt) / da);
      v[i] = std::llround((velocity[i] + gravity * force(i, k) * dt) / dv);
      angle[i] += gyro(i, k) * dt - static_cast<double>(a[i]) * da;
      velocity[i] += gravity * force(i, k) * dt - static_cast<double>(v[i]) * dv;
    }
    const double t = 320000.0 + dt * (k + 1);
    s.file +=
        fmt::format("%RAWIMUSXA,2100,{:.3f};00,5,2100,{:.9f},00001f77,{},{},{},{},{},{}*{:08x}\n",
                    t, t, v[2], -v[1], v[0], a[2], -a[1], a[0], 0x1a2b3c4d + k);
  }
  return s;
}

Shape vectornav() {
  Shape s{"TimeStartup,AngularRateX,AngularRateY,AngularRateZ,AccelX,AccelY,AccelZ,Temp,Pres\r\n",
          0.01, 1e-8, 1e-8};
  for (int k = 0; k < rows; ++k)
    s.file += fmt::format("{},{},{},{:.2f},101.325\r\n", 5'000'000'000ll + 10'000'000ll * k,
                          three(
                              "{:.9f}", [&](int i) { return gyro(i, k); }, ","),
                          three(
                              "{:.8f}", [&](int i) { return gravity * force(i, k); }, ","),
                          25.0 + 0.001 * k);
  return s;
}

Shape stim() {
  Shape s{
      "Counter\tLatency\tGyro X [deg/s]\tGyro Y [deg/s]\tGyro Z [deg/s]\tAcc X [g]\tAcc Y [g]\t"
      "Acc Z [g]\n",
      0.008, 1e-8, 1e-8};
  for (int k = 0; k < rows; ++k)
    s.file += fmt::format("{}\t506\t{}\t{}\n", (200 + k) % 256,
                          three(
                              "{:.8f}", [&](int i) { return gyro(i, k) * 180.0 / M_PI; }, "\t"),
                          three(
                              "{:.9f}", [&](int i) { return force(i, k); }, "\t"));
  return s;
}

Shape psins() {
  Shape s{"", 0.01, 1e-8, 1e-8};
  for (int k = 0; k < rows; ++k)
    s.file +=
        fmt::format("   {}   {}   {:.8e}\n",
                    three(
                        "{:.10e}", [&](int i) { return 0.01 * gyro(i, k); }, "   "),
                    three(
                        "{:.10e}", [&](int i) { return 0.01 * gravity * force(i, k); }, "   "),
                    0.01 * (k + 1));
  return s;
}

Shape ros() {
  Shape s{
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.orientation.w,"
      "field.angular_velocity.x,field.angular_velocity.y,field.angular_velocity.z,"
      "field.angular_velocity_covariance0,field.linear_acceleration.x,"
      "field.linear_acceleration.y,field.linear_acceleration.z\n",
      0.01, 1e-8, 1e-8};
  for (int k = 0; k < rows; ++k) {
    const long long stamp = 1'700'000'000'000'000'000ll + 10'000'000ll * k;
    s.file += fmt::format("{},{},{},imu_link,1.0,{},0.0,{}\n", stamp + 123456, k, stamp,
                          three(
                              "{:.9f}", [&](int i) { return gyro(i, k); }, ","),
                          three(
                              "{:.8f}", [&](int i) { return gravity * force(i, k); }, ","));
  }
  return s;
}

void expect_motion(const std::string& name, const Shape& shape) {
  SCOPED_TRACE(name);
  const test::ScratchFolder folder;
  const std::string text = recipe(name);
  ASSERT_NE(text, "");
  const std::string study = folder.write(
      "lab.toml",
      "schema = 1\n[site]\nlatitude = \"45 deg\"\ngravity = \"9.81 m/s^2\"\n[plan]\n"
      "kind = \"strapdown\"\n[[filter]]\ncoupling = \"eq5\"\nterms = [\"fixed_drift\"]\n" +
          text);
  const mc::Study read = mc::read_study(study);
  const Recording r = read_recording(folder.write("log.txt", shape.file), read.recording,
                                     RecordingKind::strapdown, read.site.gravity);
  ASSERT_EQ(r.rows(), static_cast<std::size_t>(rows));
  const std::string axes = "xyz";
  // Increments are worth rates from the second row on; the first has the usual interval.
  for (int k = 0; k < rows; ++k) {
    const auto row = static_cast<std::size_t>(k);
    ASSERT_NEAR(r.find("time")->values[row] - r.find("time")->values[0], shape.interval * k, 1e-6)
        << k;
    for (int i = 0; i < 3; ++i) {
      ASSERT_NEAR(r.find(std::string("gyro_") + axes[i])->values[row], gyro(i, k),
                  shape.gyro_rounding)
          << axes[i] << " in row " << k;
      ASSERT_NEAR(r.find(std::string("acc_") + axes[i])->values[row], force(i, k),
                  shape.force_rounding)
          << axes[i] << " in row " << k;
    }
  }
}

TEST(Recipes, ReadTheFilesThatTheyAreFor) {
  expect_motion("Xsens MT Manager", xsens());
  expect_motion("NovAtel RAWIMUSXA", novatel());
  expect_motion("VectorNav Control Center", vectornav());
  expect_motion("STIM300", stim());
  expect_motion("PSINS", psins());
  expect_motion("ROS", ros());
}

TEST(Recipes, AFileWithoutAHeaderIsReadOnlyWithNamesForAllItsColumns) {
  const test::ScratchFolder folder;
  const std::string log = folder.write("log.txt", psins().file);
  const auto problem_of = [&](const RecordingFormat& format) -> std::string {
    try {
      read_recording(log, format, RecordingKind::strapdown, gravity);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(problem_of({}).find("header = ["), std::string::npos) << problem_of({});
  RecordingFormat few;
  few.header = {"wx", "wy"};
  EXPECT_NE(problem_of(few).find("7 cells"), std::string::npos) << problem_of(few);
  EXPECT_THROW(mc::read_study(folder.write("twice.toml",
                                           "schema = 1\n[plan]\nkind = \"strapdown\"\n[recording]\n"
                                           "header = [\"a\", \"a\"]\n")),
               InputError);
}

}  // namespace
}  // namespace drift::recipes_test
