#pragma once

#include <vector>

#include "analysis/inference/marginal.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/noise/noise_model.hpp"

namespace drift::inference {

/// A component whose sigma is estimated.
struct Active {
  const NoiseComponent* component = nullptr;
  double gain = 0.0;  ///< of twice the log likelihood when it was added; 0: there from the start
};

/// A noise model at the best of its active components.
struct Mixture {
  NoiseModel model;
  std::vector<Active> active;
  double log_likelihood2 = 0.0;
  MatX covariance;  ///< of the logs of the active components' sigmas, then of their time constants

  /// Components with a time constant, in order.
  std::vector<std::size_t> timed() const {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < active.size(); ++k)
      if (active[k].component->tau) all.push_back(k);
    return all;
  }
};

/// The best sigmas and time constants of the active components, from where they are, with m's
/// covariance to begin with if it has one. A time constant far outside the test is a random walk by
/// another name: its prior holds it.
Mixture fitted(const MarginalLikelihood& rows, Mixture m);

/// The same without one of its components.
Mixture without(const MarginalLikelihood& rows, Mixture m, std::size_t k);

/// NoiseEstimate::log_price of sigmas and time constants alone.
double log_price(const Mixture& m, const NoiseModel& declared, double acc_sigma);

/// Log evidence of a mixture, its constants left out.
double log_evidence(const Mixture& m, const NoiseModel& declared, double acc_sigma);

}  // namespace drift::inference
