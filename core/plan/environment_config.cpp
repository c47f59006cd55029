#include "core/plan/environment_config.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"

namespace drift {

Environment read_environment(config::Section section) {
  using config::Option;
  Environment e;
  if (!section.present()) return e;
  constexpr Unit degC = "degC"_unit, gauss = "gauss"_unit;
  section.read(Option{"temperature", degC, -60.0, 120.0, "mean"}, e.temperature);
  section.read(Option{"temperature_amplitude", degC, 0.0, 100.0, "of its daily sine"},
               e.temperature_amplitude);
  section.read(Option{"temperature_period", unit::hour, 0.01, 1e5, "of the sine"},
               e.temperature_period);
  section.read(Option{"temperature_phase", unit::deg, -360.0, 360.0, "of the sine at the start"},
               e.temperature_phase);
  section.read(Option{"temperature_ramp", "degC/h"_unit, -100.0, 100.0, "even change"},
               e.temperature_ramp);
  section.read(Option{"temperature_fluctuation", degC, 0.0, 100.0, "1 sigma of a sample"},
               e.temperature_fluctuation);
  section.read(Option{"field_n", gauss, -1e3, 1e3, "magnetic field toward North"}, e.field_n);
  section.read(Option{"field_w", gauss, -1e3, 1e3, "toward West"}, e.field_w);
  section.read(Option{"field_u", gauss, -1e3, 1e3, "toward Up"}, e.field_u);
  for (const auto* key : {"temperature_amplitude", "temperature_period", "temperature_phase",
                          "temperature_ramp", "temperature_fluctuation"})
    if (section.has(key) && !section.has("temperature"))
      section.report().error(
          section.take(key)->at,
          fmt::format("'{}' is given without the mean (expected temperature = \"20 degC\" "
                      "beside it). Add it, or remove the line",
                      section.full(key)));
  const int fields = section.has("field_n") + section.has("field_w") + section.has("field_u");
  if (fields != 0 && fields != 3) {
    section.report().error(
        section.at(),
        fmt::format("'{}' has {} of field_n, field_w, field_u (expected all three or none, such "
                    "as \"0.26 gauss\", \"0 gauss\", \"-0.48 gauss\"). Give all three",
                    section.full("field_n"), fields));
    e.field_n.reset();
  }
  section.finish();
  return e;
}

}  // namespace drift
