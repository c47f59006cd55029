#pragma once

#include <concepts>
#include <string_view>

#include "core/params/param_spec.hpp"
#include "core/physics/assembly.hpp"
#include "core/physics/memory.hpp"

namespace drift {

/// The part of the platform that an effect comes from, as physics.md 4 groups them.
enum class Subsystem {
  gyro,
  torquer,
  servo,
  structure,
  site,
  resolvers,
  accelerometers,
  recording,
};

/// A physical effect. It declares its parameters once and adds to the slots it acts on, through one
/// or more of
///   rates            the platform's rate equation
///   readout          what the accelerometers say
///   gimbals          what the resolvers say, and the tilt of the case
///   attitude_offset  a small rotation of the platform that both see, but that no gyro integrates
/// or through none, if it is random (parameters of ParamKind::noise). A term acts on the rates or
/// on the readout, not on both. (A place for a study's own term has every hook, and uses one.)
///
/// A term may declare `needs`, what it wants to see beyond the usual (Needs), and memory: a number
/// `memory` of states with
///   start(PathStep, p, m)    what they are when a test begins; the step has no length
///   advance(PathStep, p, m)  their exact change over a step of the nominal path
/// that are handed to the hooks after the parameters. Where they may change within a step, and act
/// on the rates or on what the accelerometers read, it declares
///   moments(PathStep, p, m, moments)  their Moments over the step that begins with m
/// and steps integrate them, and rows average them, as they are (MemoryPath). Memory depends on at
/// most one parameter of the term, number `memory_parameter`.
///
/// A term that follows the temperature in ways which a thermostat leaves nothing of may declare
/// `wants_swing`: a diagnosis looks for it where the temperature has moved.
///
/// A hook only adds to its slots, and is affine in every parameter of ParamKind::linear: estimators
/// take its derivatives by differences (slot_derivatives.hpp); a test holds every term to it.
template <class T>
concept Term = requires {
  { T::key } -> std::convertible_to<std::string_view>;
  { T::title } -> std::convertible_to<std::string_view>;
  { T::equation } -> std::convertible_to<std::string_view>;
  { T::source } -> std::convertible_to<std::string_view>;
  { T::subsystem } -> std::convertible_to<Subsystem>;
  { T::params.size() } -> std::convertible_to<std::size_t>;
};

template <class T>
constexpr int memory_of() {
  if constexpr (requires { T::memory; })
    return T::memory;
  else
    return 0;
}
/// Whether a term tells the moments of its memory.
template <class T>
constexpr bool tells_moments() {
  return requires(const PathStep& along, const double* p, Moments<double>* moments) {
    T::moments(along, p, p, moments);
  };
}
template <class T>
constexpr bool wants_swing() {
  return requires {
    requires T::wants_swing;
  };
}
/// Whether a type is a place for a term that a study brings (own/own_place.hpp).
template <class T>
constexpr bool is_place() {
  return requires {
    T::place;
  };
}
template <class T>
constexpr Needs needs_of() {
  Needs needs;
  if constexpr (requires { T::needs; }) needs = T::needs;
  needs.memory = memory_of<T>() > 0;
  return needs;
}

/// A hook is hook(in, p, out) or, for a term with memory, hook(in, p, m, out).
template <class T, class S>
concept ActsOnRates = requires(const Inputs<S>& in, const S* p, RateAssembly<S>& out) {
  T::rates(in, p, out);
}
|| requires(const Inputs<S>& in, const S* p, RateAssembly<S>& out) {
  T::rates(in, p, p, out);
};
template <class T, class S>
concept ActsOnReadout = requires(const Inputs<S>& in, const S* p, ReadoutAssembly<S>& out) {
  T::readout(in, p, out);
};
template <class T, class S>
concept ActsOnGimbals = requires(const Inputs<S>& in, const S* p, GimbalAssembly<S>& out) {
  T::gimbals(in, p, out);
};
template <class T, class S>
concept OffsetsAttitude = requires(const Inputs<S>& in, const S* p, Vec3T<S>& out) {
  T::attitude_offset(in, p, out);
}
|| requires(const Inputs<S>& in, const S* p, Vec3T<S>& out) {
  T::attitude_offset(in, p, p, out);
};

/// What the `terms` command, error messages and the diagnosis need to know of a term.
struct TermInfo {
  std::string_view key, title, equation, source;
  Subsystem subsystem = {};
  std::size_t first = 0;    ///< index of its first parameter
  std::size_t count = 0;    ///< number of its parameters
  bool in_rates = false;    ///< acts on the platform's rate
  bool in_readout = false;  ///< acts on what the accelerometers say
  bool in_gimbals = false;  ///< acts on what the resolvers say
  bool in_offset = false;   ///< an attitude offset, seen by both
  Needs needs;
  int first_memory = 0;  ///< its states among those of the library
  int memory = 0;
  bool wants_swing = false;  ///< is looked for where the temperature has moved
  /// Acts through random numbers alone.
  constexpr bool stochastic() const {
    return !in_rates && !in_readout && !in_gimbals && !in_offset;
  }
};

}  // namespace drift
