#pragma once

#include "core/physics/memory.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift from convection in the flotation fluid, whose temperature field follows a change of
/// attitude with a lag. After a change from a_prev to a it is B (a - a_prev) exp(-t_p / tau). Its
/// memory is the specific force that the fluid has settled to.
struct RepositionTransient {
  static constexpr std::string_view key = "reposition_transient";
  static constexpr std::string_view title = "thermal transient after repositioning";
  static constexpr std::string_view equation =
      "w_l,i += R_i (a_I - m_i),  R_tau m_i' = a_I - m_i;  m = a at the start of the test";
  static constexpr std::string_view source =
      "physics.md 4, no. 3: 0.005 to 0.1 deg/h/g, tau 5 to 20 min; ASME J. Appl. Mech. 24 (1957) "
      "506";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      join(per_axis<"R">(unit::deg_per_h_per_g, normal(0.0, 0.05), "w_l, times the change of a_I"),
           profiled<"R_tau">(ParamKind::nonlinear, unit::minute, 10.0, {5.0, 8.0, 12.0, 20.0},
                             "w_l, time constant of the fluid"));
  static constexpr int memory = 3;
  static constexpr std::size_t memory_parameter = 3;

  template <class S>
  static void start(const PathStep& along, const S*, S* m) {
    for (int i = 0; i < 3; ++i) m[i] = S(along.f0_p[i]);
  }
  template <class S>
  static void advance(const PathStep& along, const S* p, S* m) {
    for (int i = 0; i < 3; ++i)
      m[i] = lagged(m[i], along.f0_p[i], along.f1_p[i], along.dt, time_constant(p[3]));
  }
  template <class S>
  static void rates(const Inputs<S>& in, const S* p, const S* m, RateAssembly<S>& out) {
    out.omega_drift_g += vec3(p).cwiseProduct(in.f_p - vec3(m));
  }
};

}  // namespace drift::terms
