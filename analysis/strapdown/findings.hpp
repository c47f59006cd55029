#pragma once

#include <string>
#include <vector>

#include "core/estimate/estimate_result.hpp"

namespace drift::strapdown {

/// A parameter, or a sum of some, that a recording says.
struct StrapdownParameter {
  std::string key;     ///< as in the study file
  double value = 0.0;  ///< in `unit`
  double sigma = 0.0;  ///< 1 standard deviation, in `unit`
  std::string unit;
  std::string note;  ///< what the number is relative to; empty: nothing
};

/// What the recording cannot show, and why. Never comes with a number.
struct Unobservable {
  std::string what;
  std::string reason;
};

/// What a model says of a recording's sensors.
struct Findings {
  std::vector<StrapdownParameter> parameters;  ///< of which the recording says more than the prior
  std::vector<Unobservable> unobservable;      ///< the others
};

/// Whether the gyros see the Earth's rate.
enum class EarthRate { seen, hidden };

/// A parameter is said with its number where the recording says ten times as much of it as the
/// prior (learned_ratio), or as a sum with others (known_sums); of any other what it is one with,
/// or that the recording says little of it. Where the Earth is hidden the common part of D_I_x,
/// D_I_y and D_I_z is taken out of them, and what no such recording shows is listed. sensed: as
/// as_sensed() has it.
Findings findings_of(const EstimateResult& sensed, EarthRate earth);

/// Whether it is D_I_x, D_I_y or D_I_z.
bool is_input_axis_drift(std::size_t param);

/// D_I_x, D_I_y and D_I_z less their mean, covariance included; as they are without one of them.
EstimateResult without_common_drift(EstimateResult estimate);

}  // namespace drift::strapdown
