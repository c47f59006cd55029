#pragma once

#include <cstdint>
#include <optional>

namespace drift {

struct Timeline;

/// [environment]: the surroundings of a test. A simulated recording carries them as columns. The
/// field also counts as known for a recording without one; the temperature does not.
struct Environment {
  std::optional<double> temperature;     ///< mean [degC]; empty: not recorded
  double temperature_amplitude = 0.0;    ///< of a sine [K]
  double temperature_period = 86400.0;   ///< [s]
  double temperature_phase = 0.0;        ///< of the sine at the start of the test [rad]
  double temperature_ramp = 0.0;         ///< [K/s]
  double temperature_fluctuation = 0.0;  ///< 1 sigma of each sample, linear in between [K]
  std::optional<double> field_n;         ///< local magnetic field [T]; all three or none
  std::optional<double> field_w;
  std::optional<double> field_u;

  bool has_field() const { return field_n.has_value(); }
};

/// Gives every interval of a planned timeline its surroundings: those of run `run`.
void set_environment(Timeline& timeline, const Environment& environment, std::uint64_t seed,
                     std::uint64_t run);

/// Gives a timeline laid out from a recording the field that [environment] declares, where the
/// recording has none.
void set_known_field(Timeline& timeline, const Environment& environment);

}  // namespace drift
