#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::identification {

/// The magnetic field that a recording is of, where it had to be assumed.
struct FieldFound {
  Vec3 field_l, assumed_l;  ///< North, West, Up [T]
  Mat3 covariance;          ///< of field_l [T^2]
  /// Log of how probable the field was before, and what the recording then leaves of it: the prior
  /// of what follows a field that was read off the recording.
  double log_prior = 0.0;
  /// Log evidence for a field that is only known as the Earth's is, against that of the dipole.
  double log_evidence = 0.0;
  /// By how much the estimate of a parameter that follows the field changes with it [SI/T].
  std::vector<std::pair<std::size_t, Vec3>> slopes;

  /// The recording says that it is not that of the dipole.
  bool another() const { return log_evidence > 0.0; }
  /// What the field that is not known adds to the sigma of a parameter that follows it [SI]; else
  /// 0.
  double sigma_of(std::size_t param) const;
};

/// The field and its error from the recordings themselves: the most probable one with everything
/// that follows a field in the model, of whatever size, where the Earth's is that of a dipole and
/// preparation::beside_dipole an axis. Newton's method on the cost of fits. recordings: made ready
/// (prepare()). Empty where no fit can be made.
std::optional<FieldFound> field_found(const mc::Study& study,
                                      const std::vector<Recording>& recordings,
                                      const FilterSpec& filter);

/// Whether an effect of the library follows the field.
bool follows_field(const TermInfo& term);

}  // namespace drift::identification
