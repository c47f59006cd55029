#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/check.hpp"
#include "mc/study/study.hpp"

namespace drift::test {

/// A study file in a folder of its own, gone with the object.
class StudyFile {
 public:
  explicit StudyFile(const std::string& text) {
    static std::atomic<int> count = 0;  // tests read studies on several threads
    folder_ = std::filesystem::temp_directory_path() /
              ("driftscope_study_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
    write(text);
  }
  ~StudyFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  StudyFile(const StudyFile&) = delete;
  StudyFile& operator=(const StudyFile&) = delete;

  void write(const std::string& text) const { std::ofstream(path(), std::ios::binary) << text; }
  std::string path() const { return (folder_ / "study.toml").string(); }

 private:
  std::filesystem::path folder_;
};

inline mc::Study read_text(const std::string& text, const mc::Overrides& overrides = {}) {
  const StudyFile file(text);
  return mc::read_study(file.path(), overrides);
}

/// The mistakes found in a study, without the folder; empty if it is right.
inline std::vector<std::string> mistakes(const std::string& text,
                                         const mc::Overrides& overrides = {}) {
  static const StudyFile file("");  // one for all: thousands of folders take their time
  file.write(text);
  try {
    mc::read_study(file.path(), overrides);
  } catch (const InputError& error) {
    if (error.code() != ExitCode::config) return {"wrong exit code"};
    auto messages = error.messages();
    for (auto& message : messages)
      if (message.starts_with(file.path())) message.replace(0, file.path().size(), "study.toml");
    return messages;
  }
  return {};
}

/// A study that uses every section and most keys.
inline const std::string full_study = R"toml(schema = 1
title = "Everything at once"

[site]
latitude = "45.75 deg"
gravity = "9.806 m/s^2"
note = "north pier"

[mounting]
gyro_x = "x -z y"
gyro_y = "y z x"
gyro_z = "z x y"
accelerometer_x = "x y z"
accelerometer_y = "y z x"
accelerometer_z = "z -y x"

[plan]
kind = "platform"
dwell = "60 min"
sample = "60 s"
mode = "level"
entry = "torqued"
slew_rate = "0.25 deg/s"
case_rate = "2 deg/s"
[[plan.position]]
name = "z up, x north"
axes = "x=N y=W z=U"
dwell = "30 min"
sample = "30 s"
mode = "free"
entry = "caged"
case_heading = "90 deg"
[[plan.position]]
axes = "x=U y=N z=W"

[readout]
accelerometers = true
gimbals = true
accelerometer_noise = "50 ug"
gimbal_noise = "0.5 arcmin"

[truth]
coupling = "compensated"
terms = ["fixed_drift", "g_drift.x", "D_O_z", "gyro_misalignment", "s"]
initial_attitude = "1 arcmin"
angle_random_walk = "0.001 deg/sqrt(h)"
drift_random_walk = "0.002 deg/h/sqrt(h)"
[truth.parameters]
eta = { uniform = ["-1 arcmin", "100 arcsec"] }
eta_x = { normal = ["112 arcsec", "20 arcsec"] }
D_I_x = "1.45 deg/h/g"
s_x = "500 ppm"
s_y = 1e-4
[truth.loop]
estimate = "given"
eta_x = "100 arcsec"
xi = "5 arcsec"
xi_z = "6 arcsec"

[[filter]]
name = "corrected"
coupling = "eq5"
initial_attitude = "300 arcsec"
angle_random_walk = "0.001 deg/sqrt(h)"
starts = [ { eta_x = "10 arcsec", D_F = "0.1 deg/h" }, {} ]
[filter.parameters]
K3 = "0 ug/g^3"

[[filter]]
coupling = "lambda"
terms = ["gyro_misalignment"]
starts = 3

[monte_carlo]
runs = 2000
seed = "0xFFFFFFFFFFFFFFFF"
allowed_failures = 3

[sweep]
"truth.parameters.eta_x" = ["20 arcsec", "100 arcsec"]
"filter.corrected.coupling" = ["eq5", "eq6"]
)toml";

}  // namespace drift::test
