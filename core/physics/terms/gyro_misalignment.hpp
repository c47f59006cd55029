#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Small tilts of the gyro input axes against the platform axes.
struct GyroMisalignment {
  static constexpr std::string_view key = "gyro_misalignment";
  static constexpr std::string_view title = "misalignment of the gyro input axes";
  static constexpr std::string_view equation = "row i of C_gp = e_i + eta_i e_S + xi_i e_O";
  static constexpr std::string_view source =
      "Fu, Shao, Deng, Control and Decision 17(3), 2002, eqs. (1) to (6); physics.md 1.1";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params = join(
      per_axis<"eta">(unit::arcsec, normal(0.0, 200.0), "C_gp, tilt of IA toward the spin axis"),
      per_axis<"xi">(unit::arcsec, normal(0.0, 200.0), "C_gp, tilt of IA toward the output axis"));

  template <class S>
  static void rates(const Inputs<S>& in, const S* angle, RateAssembly<S>& out) {
    for (int i = 0; i < 3; ++i) {
      const SignedAxis o = in.mounting->gyro.second[i], s = in.mounting->gyro.third[i];
      out.E_gp(i, s.index) += s.sign * angle[i];
      out.E_gp(i, o.index) += o.sign * angle[3 + i];
    }
  }
};

}  // namespace drift::terms
