#pragma once

#include <array>
#include <string_view>

#include "core/base/dual.hpp"
#include "core/base/units.hpp"
#include "core/physics/assembly.hpp"

namespace drift {

/// Something that the equation of an own term may name.
struct OwnInput {
  Name name;
  Dimension dimension;
  Needs needs;
  bool of_gyro = false;  ///< along the axes of the gyro that the term acts on
  const CovariateSpec* covariate = nullptr;
  int part = 0;  ///< of a vector which axis; of a number its value or its rate
};

namespace detail {
inline constexpr Dimension rate_dimension = "rad/s"_unit.dim;
inline constexpr Needs clock{.clock = true}, gimbals{.gimbals = true};

inline constexpr std::array motion_inputs = {
    OwnInput{{"t"}, unit::s.dim, clock},
    OwnInput{{"t_position"}, unit::s.dim, clock},
    OwnInput{{"f_x"}, unit::g.dim, {}},
    OwnInput{{"f_y"}, unit::g.dim, {}},
    OwnInput{{"f_z"}, unit::g.dim, {}},
    OwnInput{{"f_I"}, unit::g.dim, {}, true},
    OwnInput{{"f_O"}, unit::g.dim, {}, true},
    OwnInput{{"f_S"}, unit::g.dim, {}, true},
    OwnInput{{"omega_ic_x"}, rate_dimension, {}},
    OwnInput{{"omega_ic_y"}, rate_dimension, {}},
    OwnInput{{"omega_ic_z"}, rate_dimension, {}},
    OwnInput{{"cmd_x"}, rate_dimension, {}},
    OwnInput{{"cmd_y"}, rate_dimension, {}},
    OwnInput{{"cmd_z"}, rate_dimension, {}},
    OwnInput{{"gimbal_outer"}, unit::rad.dim, gimbals},
    OwnInput{{"gimbal_middle"}, unit::rad.dim, gimbals},
    OwnInput{{"gimbal_inner"}, unit::rad.dim, gimbals},
};

/// A number and its rate; a vector along the axes of the platform.
constexpr std::size_t inputs_of(const CovariateSpec& c) {
  return c.is_vector() ? 3 : 2;
}
constexpr OwnInput covariate_input(const CovariateSpec& c, std::size_t part) {
  constexpr std::array<std::string_view, 3> axes{"_x", "_y", "_z"};
  OwnInput in{c.name, c.unit.dim, {.covariates = c.set()}, false, &c, static_cast<int>(part)};
  if (c.is_vector()) in.name.append(axes[part]);
  if (c.is_vector() || part == 0) return in;
  in.name.append("_rate");
  in.dimension = c.unit_per_hour().dim;
  return in;
}
}  // namespace detail

/// Numbered as read_input() has them; the columns of the recording that a set of terms names come
/// after them.
inline constexpr auto own_inputs = [] {
  constexpr std::size_t count = [] {
    std::size_t n = detail::motion_inputs.size();
    for (const CovariateSpec& c : known_covariates) n += detail::inputs_of(c);
    return n;
  }();
  std::array<OwnInput, count> all{};
  std::size_t next = 0;
  for (const OwnInput& in : detail::motion_inputs) all[next++] = in;
  for (const CovariateSpec& c : known_covariates)
    for (std::size_t part = 0; part < detail::inputs_of(c); ++part)
      all[next++] = detail::covariate_input(c, part);
  return all;
}();

/// The value of input number `index`, SI, for a term that acts on axis or gyro `axis`.
template <class S>
S read_input(std::size_t index, int axis, const Inputs<S>& in) {
  enum { f = 2, f_I = 5, f_O, f_S, omega = 8, cmd = 11, gimbal = 14 };
  if (index >= own_inputs.size()) return S(in.now().covariates.further(index - own_inputs.size()));
  if (const OwnInput& input = own_inputs[index]; input.covariate != nullptr) {
    const CovariateSpec& c = *input.covariate;
    if (c.is_vector()) return in.vector_of(c)[input.part];
    return S(input.part == 0 ? in.value_of(c) : in.rate_of(c));
  }
  const auto k = static_cast<int>(index);
  if (k >= gimbal) return in.around->gimbal[k - gimbal];
  if (k >= cmd) return S(in.omega_cmd_p[k - cmd]);
  if (k >= omega) return in.omega_ic_p[k - omega];
  if (k == f_S) return in.f_spin()[axis];
  if (k == f_O) return in.f_output()[axis];
  if (k == f_I) return in.f_p[axis];
  if (k >= f) return in.f_p[k - f];
  return S(k == 0 ? in.now().t : in.now().t_p);
}

}  // namespace drift
