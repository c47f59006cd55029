#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/params/covariates.hpp"

namespace drift {

struct Timeline;

/// What [environment] says of one covariate.
struct CovariateCourse {
  /// Of a number its mean; the components of a vector, all three or none [SI]. Empty: not recorded.
  std::array<std::optional<double>, 3> mean;
  double amplitude = 0.0;    ///< of a sine
  double period = 86400.0;   ///< [s]
  double phase = 0.0;        ///< of the sine at the start of the test [rad]
  double ramp = 0.0;         ///< [1/s]
  double fluctuation = 0.0;  ///< 1 sigma of each sample, linear in between

  bool declared() const { return mean.front().has_value(); }
};

/// [environment]: the surroundings of a test. A simulated recording carries them as columns. A
/// vector also counts as known for a recording without it; a number does not.
struct Environment {
  std::array<CovariateCourse, known_covariates.size()> courses;

  CovariateCourse& operator[](const CovariateSpec& c) { return courses[c.number]; }
  const CovariateCourse& operator[](const CovariateSpec& c) const { return courses[c.number]; }
  CovariateSet declared() const;
  /// Whether it differs from run to run.
  bool fluctuates() const;
};

/// Gives every interval of a planned timeline its surroundings: those of run `run`.
void set_environment(Timeline& timeline, const Environment& environment, std::uint64_t seed,
                     std::uint64_t run);

/// Gives a timeline laid out from a recording the vectors that [environment] declares, where the
/// recording has none.
void set_declared_vectors(Timeline& timeline, const Environment& environment);

}  // namespace drift
