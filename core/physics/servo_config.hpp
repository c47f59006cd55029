#pragma once

#include "core/config/option.hpp"
#include "core/physics/servo_options.hpp"

namespace drift {

/// [truth.servo]: every field of ServoOptions with its unit and range.
template <class Field>
void visit_options(ServoOptions& o, Field&& field) {
  using config::Option;
  constexpr Unit inertia = "kg*m^2"_unit, torque = "N*m"_unit;
  field(Option{"wheel_momentum", "N*m*s"_unit, 1e-6, 1e3, "H"}, o.wheel_momentum);
  field(Option{"float_inertia", inertia, 1e-12, 1.0, "J_f about the output axis"}, o.float_inertia);
  field(Option{"float_damping", "N*m*s/rad"_unit, 1e-9, 1e3, "c"}, o.float_damping);
  field(Option{"float_restraint", "N*m/rad"_unit, 0.0, 1e6, "k_f"}, o.float_restraint);
  field(Option{"platform_inertia", inertia, 1e-6, 1e6, "J_p"}, o.platform_inertia);
  field(Option{"loop_gain", "N*m/rad"_unit, 1e-6, 1e9, "K"}, o.loop_gain);
  field(Option{"lead", unit::s, 0.0, 100.0, "T1 of the compensator"}, o.lead);
  field(Option{"lag", unit::s, 1e-6, 100.0, "T2 of the compensator"}, o.lag);
  field(Option{"viscous", "N*m*s/rad"_unit, 0.0, 1e3, "viscous gimbal friction"}, o.viscous);
  field(Option{"coulomb", torque, 0.0, 1e3, "Coulomb gimbal friction"}, o.coulomb);
  field(Option{"coulomb_rate", "rad/s"_unit, 1e-12, 10.0, "rate at which it saturates"},
        o.coulomb_rate);
  field(Option{"constant_torque", torque, -1e3, 1e3, "flex leads, one per axis"},
        o.constant_torque);
  field(Option{"motor_coupling", unit::one, -10.0, 10.0, "decoupling matrix of the motors"},
        o.motor_coupling);
  field(Option{"base_amplitude", unit::deg, 0.0, 10.0, "angular base motion"}, o.base_amplitude);
  field(Option{"base_frequency", "Hz"_unit, 0.0, 1e3, "of the base motion"}, o.base_frequency);
}

}  // namespace drift
