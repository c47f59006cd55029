#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Which drift equation holds, as a number: 0 is eq. (5), 1 is eq. (6). Used by coupling "lambda".
struct FrameClosure {
  static constexpr std::string_view key = "frame_closure";
  static constexpr std::string_view title = "weight of eq. (6) in the family of drift equations";
  static constexpr std::string_view equation = "w_cp = -(I + lambda E)^-1 (C w_ic + w_l + w_md)";
  static constexpr std::string_view source = "physics.md 1.3";
  static constexpr Subsystem subsystem = Subsystem::servo;
  static constexpr auto params =
      single<"lambda">(unit::one, uniform(0.0, 1.0), "closure of the servo loop over C_gp");

  template <class S>
  static void rates(const Inputs<S>&, const S* lambda, RateAssembly<S>& out) {
    out.lambda += lambda[0];
  }
};

}  // namespace drift::terms
