#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "core/base/check.hpp"
#include "core/base/rng.hpp"
#include "core/recording/recording.hpp"

namespace drift::test {

/// A folder of its own for one test, removed with all it holds.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / "driftscope_test.XXXXXX") {
    std::string name = path_.string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, std::string_view text) const {
    std::ofstream(*this / name, std::ios::binary) << text;
    return *this / name;
  }
  std::size_t count() const {
    std::size_t n = 0;
    for ([[maybe_unused]] const auto& e : std::filesystem::directory_iterator(path_)) ++n;
    return n;
  }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

inline constexpr double gravity = 9.80665;  // [m/s^2]

/// A platform recording of two positions with full-precision numbers, some not measured.
inline Recording platform_recording() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Recording r;
  r.facts = {{"sensor", "test table"}, {"note", "angles = resolver, 20 °C"}};
  const auto add = [&](const char* name, const char* unit, auto value) {
    Channel c{name, *parse_unit(unit), {}};
    for (int i = 0; i < 40; ++i) c.values.push_back(value(i));
    r.channels.push_back(std::move(c));
  };
  add("time", "min", [](int i) { return 60.0 * (i + 1) + (i < 20 ? 0.0 : 1234.5); });
  add("position", "1", [](int i) { return i < 20 ? 1.0 : 2.0; });
  add("phase", "1", [](int i) { return i == 20 ? 1.0 : 0.0; });
  for (const char* name : {"acc_x", "acc_y", "acc_z"})
    add(name, "mg", [&](int i) { return i == 7 ? nan : std::sin(1.7 * i + name[4]); });
  for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
    add(name, "deg", [&](int i) { return 3.0 * std::cos(0.9 * i + name[7]); });
  for (const char* name : {"cmd_x", "cmd_y", "cmd_z"})
    add(name, "deg/h", [&](int i) { return 7e-5 * std::cos(0.3 * i + name[4]); });
  add("case_heading", "deg", [](int i) { return 0.01 * i; });
  add("temperature", "degC", [](int i) { return 20.0 + std::sqrt(i); });
  add("field_n", "gauss", [](int i) { return 2e-5 * std::exp(-0.1 * i); });
  add("wobble", "1", [](int i) { return std::pow(-1.3, i) * 1e-200; });
  return r;
}

/// Distance of two doubles in units in the last place; 0 for two NaN.
inline double ulps(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0.0;
  if (a == b) return 0.0;
  return std::abs(a - b) / (std::nextafter(std::abs(a), HUGE_VAL) - std::abs(a));
}

/// What reading answers: "" if it reads, else all messages; the exit code beside it, -1 if what is
/// read is refused as a recording.
struct Reading {
  int code = 0;
  std::string text;
};
inline Reading answer(const std::string& path, RecordingKind kind) {
  Recording read;
  try {
    read = read_recording(path, kind, gravity);
  } catch (const InputError& e) {
    return {static_cast<int>(e.code()), e.what()};
  }
  try {
    check_recording(read, kind);
    return {};
  } catch (const InputError& e) {
    return {-1, e.what()};
  }
}

}  // namespace drift::test
