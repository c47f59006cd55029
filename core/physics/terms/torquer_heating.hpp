#pragma once

#include "core/physics/memory.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// The torquer heats the float in proportion to the square of its current; the heat leaks away. Its
/// memory h is 1 right after a slew of 90 deg at 0.5 deg/s (less what leaked away meanwhile).
struct TorquerHeating {
  static constexpr std::string_view key = "torquer_heating";
  static constexpr std::string_view title = "drift from the torquers' self-heating";
  static constexpr std::string_view equation =
      "w_l,i += heat_i h_i,  h_i' = (w_cmd,i / 0.5 deg/s)^2 / 180 s - h_i / heat_tau;  h = 0 at "
      "the start";
  static constexpr std::string_view source =
      "physics.md 4, no. 21: 0.01 to 0.1 deg/h after a slew, tau 10 to 30 min";
  static constexpr Subsystem subsystem = Subsystem::torquer;
  static constexpr auto params =
      join(per_axis<"heat">(unit::deg_per_h, normal(0.0, 0.05), "w_l, after a slew of 90 deg"),
           profiled<"heat_tau">(ParamKind::nonlinear, unit::minute, 15.0, {8.0, 12.0, 20.0, 30.0},
                                "w_l, time constant of the heat"));
  static constexpr int memory = 3;
  static constexpr std::size_t memory_parameter = 3;
  static constexpr double slew_rate = 0.5 * detail::deg, slew_time = 180.0;  // [rad/s], [s]

  template <class S>
  static void start(const PathStep&, const S*, S* h) {
    for (int i = 0; i < 3; ++i) h[i] = S(0.0);
  }
  template <class S>
  static void advance(const PathStep& along, const S* p, S* h) {
    const S tau = time_constant(p[3]);
    for (int i = 0; i < 3; ++i) {
      const double w = along.omega_cmd_p[i] / slew_rate;
      const S settled = w * w / slew_time * tau;
      using std::exp;
      h[i] = settled + (h[i] - settled) * exp(-along.dt / tau);
    }
  }
  template <class S>
  static void rates(const Inputs<S>&, const S* p, const S* h, RateAssembly<S>& out) {
    out.omega_drift_g += vec3(p).cwiseProduct(vec3(h));
  }
};

}  // namespace drift::terms
