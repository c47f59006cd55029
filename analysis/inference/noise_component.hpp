#pragma once

#include <vector>

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise_model.hpp"

namespace drift::inference {

/// One standard deviation of the noise model.
struct NoiseComponent {
  const char* name;  ///< of NoiseFinding
  double NoiseModel::*sigma;
  double NoiseModel::*tau;  ///< null if it has none
  double reference;         ///< a size at which it may begin to matter, SI
  const char* unit;
  double to_unit;  ///< SI per unit

  bool white() const {
    return sigma == &NoiseModel::acc_factor || sigma == &NoiseModel::gimbal_factor;
  }
  bool in(const NoiseModel& m) const { return m.*sigma > 0.0; }
};

extern const NoiseComponent acc_white, gimbal_white, angle_walk, drift_walk, markov_drift,
    acc_markov;

/// Rows of the instruments.
struct RowCounts {
  std::size_t accelerometer = 0, gimbal = 0;
  explicit RowCounts(const MeasuredRows& rows);
  std::size_t of(const NoiseComponent& white) const {
    return &white == &acc_white ? accelerometer : gimbal;
  }
};

/// A component that may be added, with the time constant to be tried [s].
struct Addition {
  const NoiseComponent* component = nullptr;
  double tau = 0.0;
};

/// What `model` leaves out and the rows can show: time constants on a coarse grid.
std::vector<Addition> possible_additions(const NoiseModel& model, const RowCounts& rows);

}  // namespace drift::inference
