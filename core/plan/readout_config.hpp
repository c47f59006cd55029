#pragma once

#include "core/config/option.hpp"
#include "core/physics/earth.hpp"
#include "core/plan/readout.hpp"

namespace drift {

/// [readout]. Noise is never zero: a filter weighs a measurement by it.
template <class Field>
void visit_options(Readout& o, Field&& field) {
  using config::Option;
  field(Option{.key = "accelerometers", .doc = "the accelerometers are read"}, o.accelerometers);
  field(Option{.key = "gimbals", .doc = "the gimbal resolvers are read"}, o.gimbals);
  field(Option{"accelerometer_noise", unit::ug, 1e-3, 1e6, "1 sigma of the mean over one sample"},
        o.accelerometer_noise);
  field(Option{"gimbal_noise", unit::arcsec, 1e-3, 36000.0, "1 sigma of one reading"},
        o.gimbal_noise);
}

/// The smallest noise that [readout] may declare under a key [internal unit].
inline double least_noise(std::string_view key) {
  double least = 0.0;
  Readout any;
  visit_options(any, [&](const config::Option& option, auto&) {
    if (option.key == key) least = option.min * option.unit.to_si;
  });
  return least;
}

/// [site].
template <class Field>
void visit_options(Site& o, Field&& field) {
  using config::Option;
  field(Option{"latitude", unit::deg, -90.0, 90.0, "geodetic, North positive"}, o.latitude);
  field(Option{"gravity", "m/s^2"_unit, 9.0, 11.0, "local g"}, o.gravity);
}

}  // namespace drift
