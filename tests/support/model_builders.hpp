#pragma once

#include <string_view>

#include "core/physics/earth.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/sim/simulate.hpp"

namespace drift::test {

inline constexpr double arcsec = detail::deg / 3600.0;     // [rad]
inline constexpr double deg_per_h = detail::deg / 3600.0;  // [rad/s]
inline const Site harbin{45.75 * detail::deg};

inline std::size_t param(std::string_view key) {
  return TermLibrary::find(key).value();
}

/// The six base terms (all parameters but lambda), default priors.
inline ModelSpec base_spec(Coupling coupling) {
  ModelSpec spec;
  spec.coupling = coupling;
  spec.active = base_parameters();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    spec.priors[i] = TermLibrary::specs[i].prior_si();
  return spec;
}

inline TruthSpec base_truth(Coupling coupling) {
  TruthSpec truth;
  static_cast<ModelSpec&>(truth) = base_spec(coupling);
  return truth;
}

inline FilterSpec base_filter(Coupling coupling) {
  FilterSpec filter;
  static_cast<ModelSpec&>(filter) = base_spec(coupling);
  filter.name = "filter";
  return filter;
}

/// A spec of exactly these parameters or groups ("D_I_z", "eta").
inline ParamMask only(std::initializer_list<std::string_view> keys) {
  ParamMask mask;
  for (const auto key : keys)
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
      if (TermLibrary::specs[i].key.view() == key || TermLibrary::specs[i].group.view() == key)
        mask.set(i);
  return mask;
}

/// A seeded draw of all base parameters from their default priors.
inline Theta random_theta(std::uint64_t seed) {
  return draw_parameters(base_spec(Coupling::eq5), seed, 0, Purpose::test);
}

inline Timeline preset_timeline(std::string_view preset, CommandLaw mode, double dwell = 3600.0,
                                double sample = 60.0) {
  PlanDefaults defaults;
  defaults.mode = mode;
  defaults.dwell = dwell;
  defaults.sample = sample;
  return lay_out(preset_plan(preset, defaults).value(), harbin);
}

}  // namespace drift::test
