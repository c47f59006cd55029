#pragma once

#include <cmath>

#include "core/sim/truth.hpp"

namespace drift {

/// What estimates are compared with, theta being the parameters of a truth, SI: NaN where the truth
/// has no such value. That is lambda where set_lambda() has none, and the setting (a period, a time
/// constant) of an effect that is not in the truth; the size of such an effect is 0.
inline Theta judged_truth(const TruthSpec& truth, Theta theta) {
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (!truth.active[i] && TermLibrary::specs[i].setting()) theta[i] = std::nan("");
  set_lambda(truth, theta);
  return theta;
}

}  // namespace drift
