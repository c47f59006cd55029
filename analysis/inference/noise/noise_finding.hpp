#pragma once

#include <cstddef>
#include <string>

namespace drift::inference {

/// Noise that is not as declared.
struct NoiseFinding {
  std::string component;  ///< gimbal_white, accelerometer_white, angle_random_walk,
                          ///< drift_random_walk, markov_drift, caging_drift,
                          ///< accelerometer_markov, outliers
  double factor = 1.0;    ///< estimated over declared sigma (white); NaN where nothing was declared
  double factor_sigma = 0.0;
  double value = 0.0;  ///< 1 sigma in `unit`
  std::string unit;
  double tau_s = 0.0;  ///< Markov and correlated noise [s]
  double log_likelihood_gain = 0.0;
  double p_value = 1.0;
  bool significant = false;
  std::size_t count = 0;  ///< outliers: samples left out
};

/// White noise of so many rows, estimated over declared; its log has the standard deviation given.
NoiseFinding white_finding(std::string component, double factor, double log_sigma,
                           std::size_t rows);

}  // namespace drift::inference
