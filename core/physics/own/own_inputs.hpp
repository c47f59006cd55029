#pragma once

#include <array>
#include <string_view>

#include "core/base/dual.hpp"
#include "core/base/units.hpp"
#include "core/physics/assembly.hpp"

namespace drift {

/// Something that the equation of an own term may name.
struct OwnInput {
  std::string_view name;
  Dimension dimension;
  Needs needs;
  bool of_gyro = false;  ///< along the axes of the gyro that the term acts on
};

namespace detail {
inline constexpr Dimension rate_dimension = "rad/s"_unit.dim;
inline constexpr Needs clock{.clock = true}, gimbals{.gimbals = true};
inline constexpr Needs temperature{.temperature = true}, field{.field = true};
}  // namespace detail

/// Numbered as read_input() has them; the columns of the recording that a set of terms names come
/// after them.
inline constexpr std::array own_inputs = {
    OwnInput{"t", unit::s.dim, detail::clock},
    OwnInput{"t_position", unit::s.dim, detail::clock},
    OwnInput{"f_x", unit::g.dim, {}},
    OwnInput{"f_y", unit::g.dim, {}},
    OwnInput{"f_z", unit::g.dim, {}},
    OwnInput{"f_I", unit::g.dim, {}, true},
    OwnInput{"f_O", unit::g.dim, {}, true},
    OwnInput{"f_S", unit::g.dim, {}, true},
    OwnInput{"omega_ic_x", detail::rate_dimension, {}},
    OwnInput{"omega_ic_y", detail::rate_dimension, {}},
    OwnInput{"omega_ic_z", detail::rate_dimension, {}},
    OwnInput{"cmd_x", detail::rate_dimension, {}},
    OwnInput{"cmd_y", detail::rate_dimension, {}},
    OwnInput{"cmd_z", detail::rate_dimension, {}},
    OwnInput{"gimbal_outer", unit::rad.dim, detail::gimbals},
    OwnInput{"gimbal_middle", unit::rad.dim, detail::gimbals},
    OwnInput{"gimbal_inner", unit::rad.dim, detail::gimbals},
    OwnInput{"temperature", "K"_unit.dim, detail::temperature},
    OwnInput{"temperature_rate", "K/s"_unit.dim, detail::temperature},
    OwnInput{"field_x", "T"_unit.dim, detail::field},
    OwnInput{"field_y", "T"_unit.dim, detail::field},
    OwnInput{"field_z", "T"_unit.dim, detail::field},
};

/// The value of input number `index`, SI, for a term that acts on axis or gyro `axis`.
template <class S>
S read_input(std::size_t index, int axis, const Inputs<S>& in) {
  enum { f = 2, f_I = 5, f_O, f_S, omega = 8, cmd = 11, gimbal = 14, field = 19 };
  const auto k = static_cast<int>(index);
  if (k >= static_cast<int>(own_inputs.size()))
    return S(in.now().covariates[index - own_inputs.size()]);
  if (k >= field) return in.to_platform(in.now().field_l.template cast<S>())[k - field];
  if (k == field - 1) return S(in.now().temperature_rate);
  if (k == field - 2) return S(in.now().temperature);
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
