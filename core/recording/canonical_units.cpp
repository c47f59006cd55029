#include "core/recording/canonical_units.hpp"

#include "core/recording/recording_channels.hpp"

namespace drift {

Recording in_canonical_units(Recording recording) {
  for (Channel& c : recording.channels) {
    if (c.name.starts_with("acc_") && c.unit.dim == unit::g.dim) c.unit = unit::g;
    if (c.name == "time") c.unit = unit::s;
    if ((c.name.starts_with("gimbal_") || c.name == "case_heading") && known_quantity(c.name))
      c.unit = unit::deg;
    if (c.name.starts_with("cmd_") && known_quantity(c.name)) c.unit = unit::deg_per_h;
    if (c.name.starts_with("gyro_") && known_quantity(c.name)) c.unit = unit::deg_per_s;
  }
  return recording;
}

}  // namespace drift
