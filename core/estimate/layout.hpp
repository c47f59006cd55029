#pragma once

#include <vector>

#include "core/physics/model_spec.hpp"

namespace drift {

/// Which parameters are states of an estimator, in which order, and what is believed of them.
///
/// States are kept divided by their prior sigma, so that all are of order one (physics.md 6.6).
/// Parameters of the rate equation come first, those of the readout alone after them.
struct Layout {
  std::vector<std::size_t> params;  ///< library index of each state
  std::size_t num_rate = 0;         ///< the first num_rate states act on the platform's rate
  VecX mean;                        ///< prior mean of each state, SI
  VecX sigma;                       ///< prior sigma of each state, SI, > 0
  Theta theta;                      ///< all parameters at the prior mean; known constants included

  std::size_t size() const { return params.size(); }

  /// All parameters for scaled deviations x from the prior mean.
  Theta theta_at(const VecX& x) const {
    Theta t = theta;
    for (std::size_t k = 0; k < size(); ++k) t[params[k]] = mean[k] + sigma[k] * x[k];
    return t;
  }
  /// The inverse: scaled deviations of `values`.
  VecX scaled(const Theta& values) const {
    VecX x(size());
    for (std::size_t k = 0; k < size(); ++k) x[k] = scaled(values, k);
    return x;
  }
  /// That of state k alone.
  double scaled(const Theta& values, std::size_t k) const {
    return (values[params[k]] - mean[k]) / sigma[k];
  }
};

/// Whether a filter may have a parameter as a state. Of a discrete one it knows the value; of the
/// size of something random, the root mean square.
inline bool can_be_state(const ParamSpec& spec) {
  return spec.amplitude() || spec.continuous();
}

/// The layout of a model with priors: every active parameter whose prior is not fixed is a state.
Layout make_layout(const ModelSpec& spec);

}  // namespace drift
