#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The gyro input axes creep in their mounting.
struct MisalignmentCreep {
  static constexpr std::string_view key = "misalignment_creep";
  static constexpr std::string_view title = "creep of the gyro misalignment";
  static constexpr std::string_view equation = "row i of C_gp += (eta_t_i e_S + xi_t_i e_O) t";
  static constexpr std::string_view source = "physics.md 4, no. 33: 0.5 to 5 arcsec/h";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params = join(per_axis<"eta_t">("arcsec/h"_unit, normal(0.0, 3.0),
                                                        "C_gp, creep of IA toward the spin axis"),
                                      per_axis<"xi_t">("arcsec/h"_unit, normal(0.0, 3.0),
                                                       "C_gp, creep of IA toward the output axis"));
  static constexpr Needs needs{.clock = true};

  template <class S>
  static void rates(const Inputs<S>& in, const S* rate, RateAssembly<S>& out) {
    const double t = in.now().t;
    for (int i = 0; i < 3; ++i) {
      const SignedAxis o = in.mounting->gyro.second[i], s = in.mounting->gyro.third[i];
      out.E_gp(i, s.index) += s.sign * t * rate[i];
      out.E_gp(i, o.index) += o.sign * t * rate[3 + i];
    }
  }
};

}  // namespace drift::terms
