#pragma once

#include <string>
#include <vector>

#include "analysis/strapdown/ladder.hpp"

namespace drift::strapdown {

/// A parameter of the model the held-out data accept.
struct StrapdownParameter {
  std::string key;     ///< as in interfaces.md 4
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

/// The parameters of a model, in the units of the term library. The common part of D_I_x, D_I_y,
/// D_I_z is taken out of them: it is not observable.
std::vector<StrapdownParameter> parameters_of(const Final& accepted);

/// What no strapdown recording of this kind shows, and what this model leaves open.
std::vector<Unobservable> unobservable_of(const Final& accepted);

}  // namespace drift::strapdown
