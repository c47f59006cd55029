#pragma once

#include <cmath>

#include "core/estimate/layout.hpp"
#include "core/estimate/strapdown/case_test.hpp"
#include "core/estimate/strapdown/gyrocompass.hpp"
#include "tests/support/strapdown_recording.hpp"

/// A strapdown unit of a laboratory: made, turned, laid out.
namespace drift::strapdown::case_unit {

using test::set;

inline constexpr Site site{0.6, 9.8};

/// A navigation-grade unit; the sensors' convention.
inline Theta sensors() {
  Theta theta = Theta::Zero();
  for (const auto& [key, value] : std::initializer_list<std::pair<const char*, double>>{
           {"D_F_x", 0.1}, {"D_F_y", -0.2}, {"D_F_z", 0.3}, {"s_x", 40},   {"s_y", -25},
           {"s_z", 60},    {"eta_x", 30},   {"eta_y", -45}, {"eta_z", 20}, {"xi_x", 15},
           {"xi_y", 50},   {"xi_z", -35},   {"K0_x", 40},   {"K0_y", -60}, {"K0_z", 25},
           {"K1_x", 50},   {"K1_y", -30},   {"K1_z", 70},   {"dO_y", 20},  {"dP_z", -30},
           {"dO_z", 10}})
    set(theta, key, value);
  return theta;
}

inline test::StrapdownScript script(std::uint64_t seed) {
  test::StrapdownScript s;
  s.dwells = 16;
  s.rest = 20.0;
  s.turn = 8.0;
  s.gyro_noise = 3e-6;
  s.acc_noise = 1e-4;
  s.omega_ie_l = site.omega_ie_l();
  s.seed = seed;
  return s;
}

inline FilterSpec filter_for(const CaseTest& test, double attitude) {
  FilterSpec f;
  f.coupling = Coupling::eq6;  // of a platform that is told what its gyros read
  for (const char* group : {"D_F", "s", "eta", "xi", "K0", "K1", "dP", "dO"})
    for (std::size_t p = 0; p < TermLibrary::num_params; ++p)
      if (TermLibrary::specs[p].group.view() == group) {
        f.active.set(p);
        f.priors[p] = TermLibrary::specs[p].prior_si();
      }
  for (const std::size_t p : zero_by_definition) f.priors[p] = fixed(0.0);
  f.initial_attitude = attitude;
  f.noise.angle_random_walk = test.angle_random_walk;
  return f;
}

struct Unit {
  CaseTest test;
  Gyrocompass compass;
};

inline Unit unit_of(const Signals& signals, InTurns in_turns = InTurns::left_out) {
  const auto dwells = find_dwells(signals, {}).dwells;
  Unit u;
  std::vector<double> azimuth;
  for (int round = 0; round < 3; ++round) {
    u.test = lay_out_case(signals, dwells, site, Carry::through, azimuth, in_turns);
    u.compass = gyrocompass(u.test, azimuth, 1.0 * unit::deg_per_h.to_si);
    azimuth = u.compass.azimuth;
  }
  return u;
}

inline Unit unit_of(const test::StrapdownScript& script, const Theta& theta = sensors(),
                    InTurns in_turns = InTurns::left_out) {
  return unit_of(signals_of(strapdown_recording(script, theta)), in_turns);
}

/// The platform's parameters that stand for the sensors' (case_test.hpp).
inline double as_platform(std::size_t param, const Theta& sensors) {
  const double value = sensors[static_cast<Eigen::Index>(param)];
  return TermLibrary::specs[param].group.view() == "s" ? 1.0 / (1.0 + value) - 1.0 : value;
}

}  // namespace drift::strapdown::case_unit
