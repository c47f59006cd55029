#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/rng.hpp"
#include "core/physics/term_library.hpp"
#include "core/recording/recording.hpp"

namespace drift::test {

/// A strapdown test whose motion is known in closed form: the case rests, turns about an axis fixed
/// in it at a rate that rises and falls as 1 - cos, rests again. Written apart from the estimator:
/// the sensor equations are spelt out here.
struct StrapdownScript {
  std::size_t dwells = 30;
  double rest = 5.0;               ///< length of a dwell [s]
  double turn = 2.5;               ///< length of a turn [s]
  double interval = 0.01;          ///< [s]
  double gyro_noise = 0.01;        ///< of one sample, 1 sigma [rad/s]
  double acc_noise = 0.0015;       ///< of one sample, 1 sigma [g]
  Vec3 omega_ie_l = Vec3::Zero();  ///< Earth rate, along the local axes [rad/s]
  double gravity = 9.8;            ///< [m/s^2]; lever arms are felt against it
  std::uint64_t seed = 1;
  Mat3 attitude = Mat3::Identity();  ///< of the case against the local axes, at the start
};

/// The text of a study of such a recording, with the sensors' own parameters in the model.
inline std::string strapdown_study(std::string_view latitude, std::string_view gravity) {
  return "schema = 1\n[site]\nlatitude = \"" + std::string(latitude) + "\"\ngravity = \"" +
         std::string(gravity) +
         "\"\n[plan]\nkind = \"strapdown\"\n[[filter]]\nname = \"nominal\"\ncoupling = \"eq5\"\n"
         "terms = [\"fixed_drift\", \"gyro_misalignment\", \"torquer_scale\", \"K0\", \"K1\", "
         "\"dP\", \"dO\"]\n";
}

inline double param(const Theta& theta, std::string_view group, int axis) {
  std::string key(group);
  key += "_";
  key += "xyz"[axis];
  return theta[static_cast<Eigen::Index>(*TermLibrary::find(key))];
}

/// Gyro outputs [rad/s]: w_g,i = (1 + s_i)(w_i + xi_i w_O + eta_i w_S) + s_a,i |w_i| + drift.
inline Vec3 gyro_output(const Theta& t, const Vec3& w, const Vec3& f) {
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const int o = (i + 1) % 3, s = (i + 2) % 3;
    out[i] =
        (1.0 + param(t, "s", i)) * (w[i] + param(t, "xi", i) * w[o] + param(t, "eta", i) * w[s]) +
        param(t, "s_a", i) * std::abs(w[i]) + param(t, "D_F", i) + param(t, "D_I", i) * f[i] +
        param(t, "D_O", i) * f[o] + param(t, "D_S", i) * f[s] + param(t, "D_IS", i) * f[i] * f[s];
  }
  return out;
}

/// Accelerometer outputs [g].
inline Vec3 accelerometer_output(const Theta& t, const Vec3& f) {
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const int p = (i + 1) % 3, o = (i + 2) % 3;
    out[i] =
        param(t, "K0", i) +
        (1.0 + param(t, "K1", i)) * (f[i] + param(t, "dP", i) * f[p] + param(t, "dO", i) * f[o]) +
        param(t, "K2", i) * f[i] * f[i];
  }
  return out;
}

/// What accelerometers away from the centre read of a turn: w' x r + w x (w x r) [g].
inline Vec3 felt_in_turn(const Theta& t, const Vec3& w, const Vec3& acceleration, double gravity) {
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const Vec3 r(param(t, "arm_x", i), param(t, "arm_y", i), param(t, "arm_z", i));
    out[i] = (acceleration.cross(r) + w.cross(w.cross(r)))[i] / gravity;
  }
  return out;
}

/// The recording of a script with sensors of parameters theta (SI).
inline Recording strapdown_recording(const StrapdownScript& script, const Theta& theta) {
  Recording r;
  r.source = "simulated";
  r.channels = {{"time", unit::s, {}}};
  for (const char* name : {"gyro_x", "gyro_y", "gyro_z"})
    r.channels.push_back({name, *parse_unit("rad/s"), {}});
  for (const char* name : {"acc_x", "acc_y", "acc_z"}) r.channels.push_back({name, unit::g, {}});
  Stream path(script.seed, 0, Purpose::test, 0), noise(script.seed, 0, Purpose::test, 1);
  double t = 0.0;
  Mat3 R_lc = script.attitude;  // at the start of the dwell or turn
  const double delay = theta[static_cast<Eigen::Index>(*TermLibrary::find("acc_delay"))];
  const auto sample = [&](const Mat3& attitude, const Vec3& w, const Vec3& acceleration) {
    t += script.interval;
    const Vec3 f = attitude.transpose() * Vec3::UnitZ();
    const Vec3 turning = w + attitude.transpose() * script.omega_ie_l;
    const Vec3 gyro = gyro_output(theta, turning, f);
    const Vec3 before = rotation(Vec3(delay * w - 0.5 * delay * delay * acceleration)) * f;
    const Vec3 acc = accelerometer_output(theta, delay == 0.0 ? f : before) +
                     felt_in_turn(theta, w, acceleration, script.gravity);
    r.channels[0].values.push_back(t);
    for (int i = 0; i < 3; ++i) {
      r.channels[1 + i].values.push_back(gyro[i] + script.gyro_noise * noise.normal());
      r.channels[4 + i].values.push_back(acc[i] + script.acc_noise * noise.normal());
    }
  };
  for (std::size_t d = 0; d < script.dwells; ++d) {
    const auto resting = static_cast<int>(std::lround(script.rest / script.interval));
    for (int k = 0; k < resting; ++k) sample(R_lc, Vec3::Zero(), Vec3::Zero());
    if (d + 1 == script.dwells) break;
    const Vec3 axis = Vec3{path.normal(), path.normal(), path.normal()}.normalized();
    const double sign = path.uniform() < 0.5 ? -1.0 : 1.0;
    const double angle = sign * (0.7 + 1.8 * path.uniform());  // [rad]
    const auto steps = static_cast<int>(std::lround(script.turn / script.interval));
    for (int k = 1; k <= steps; ++k) {
      const double phase = 2.0 * std::numbers::pi * k / steps;
      const double turned = angle * (phase - std::sin(phase)) / (2.0 * std::numbers::pi);
      const double rate = angle / script.turn * (1.0 - std::cos(phase));
      const double acceleration =
          angle / script.turn * 2.0 * std::numbers::pi / script.turn * std::sin(phase);
      sample(R_lc * rotation(Vec3(turned * axis)), rate * axis, acceleration * axis);
    }
    R_lc = R_lc * rotation(Vec3(angle * axis));
  }
  for (std::size_t k = 0; k < r.rows(); ++k) r.lines.push_back(k + 2);
  return r;
}

/// The same as counts of angle and velocity, `angle` [rad] and `velocity` [g s] each: what has not
/// become a whole count by the end of a row is counted in a later one.
inline Recording in_counts(Recording r, double angle, double velocity) {
  const double interval = r.channels[0].values[1] - r.channels[0].values[0];
  for (std::size_t c = 1; c < r.channels.size(); ++c) {
    const double count = r.channels[c].name.starts_with("gyro_") ? angle : velocity;
    double sum = 0.0, counted = 0.0;
    for (double& value : r.channels[c].values) {
      sum += value * interval;
      const double counts = std::round(sum / count);
      value = (counts - std::exchange(counted, counts)) * count / interval;
    }
  }
  return r;
}

/// Sets one parameter, in the unit of the library.
inline void set(Theta& theta, std::string_view key, double value) {
  const auto index = *TermLibrary::find(key);
  theta[static_cast<Eigen::Index>(index)] = value * TermLibrary::specs[index].unit.to_si;
}

}  // namespace drift::test
