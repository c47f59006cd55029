#pragma once

#include "core/physics/expression/evaluate.hpp"
#include "core/physics/own/own_inputs.hpp"
#include "core/physics/own/own_term.hpp"
#include "core/physics/term.hpp"

namespace drift {

/// What stands in a place: all that is needed to evaluate it.
struct OwnContents {
  EquationProgram program;  ///< empty: nobody uses the place
  OwnTarget target;
};

/// The contents of the places. They belong to the process: a program reads one study, whose terms
/// are set when it is read, before any thread starts, and stay until another is read
/// (set_own_terms()).
inline std::array<OwnContents, most_own_terms> own_contents;

template <class S>
[[gnu::noinline]] S own_value(const OwnContents& own, const Inputs<S>& in, const S* p) {
  return evaluate_program(own.program, p, [&](int index) {
    return read_input(static_cast<std::size_t>(index), own.target.axis, in);
  });
}

/// A place at the end of the library that a study's own term may take. What it is called, what its
/// parameters are and what it acts on is known when the study is read: TermLibrary::terms and
/// ::specs say so then.
template <std::size_t I>
struct OwnPlace {
  static constexpr bool place = true;
  static constexpr std::string_view key = {}, title = {}, equation = {}, source = {};
  static constexpr Subsystem subsystem = Subsystem::structure;
  static constexpr std::array<ParamSpec, most_own_parameters> params{};
  static constexpr Needs needs{.clock = true};

  template <class S>
  static void rates(const Inputs<S>& in, const S* p, RateAssembly<S>& out) {
    const OwnContents& own = own_contents[I];
    if (own.target.slot == OwnSlot::rate)
      out.omega_ip_p[own.target.axis] += own_value(own, in, p);
    else if (own.target.slot == OwnSlot::drift)
      out.omega_drift_g[own.target.axis] += own_value(own, in, p);
  }
  template <class S>
  static void readout(const Inputs<S>& in, const S* p, ReadoutAssembly<S>& out) {
    const OwnContents& own = own_contents[I];
    if (own.target.slot == OwnSlot::accelerometer)
      out.acc[own.target.axis] += own_value(own, in, p);
  }
  template <class S>
  static void gimbals(const Inputs<S>& in, const S* p, GimbalAssembly<S>& out) {
    const OwnContents& own = own_contents[I];
    if (own.target.slot == OwnSlot::gimbal) out.error[own.target.axis] += own_value(own, in, p);
  }
};

}  // namespace drift
