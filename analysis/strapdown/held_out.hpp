#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/estimate/strapdown/rotation_fit.hpp"

namespace drift::strapdown {

/// Which parameters are estimated, and by which equation the gyros are read.
struct Model {
  Coupling equation = Coupling::eq5;
  AccelerometerModel accelerometer = AccelerometerModel::nominal;
  DriftOrder drift = DriftOrder::fixed;
  std::vector<std::size_t> turning;  ///< of s, eta, xi: estimated from rotations
};

/// Dwells and rotations of one recording, with outputs as they were read.
struct Evidence {
  std::vector<Dwell> dwells;
  std::vector<Rotation> rotations;
};

/// A model fitted to some dwells and rotations. `turning.theta` holds the drift as well.
struct Fitted {
  Estimate accelerometer, drift, turning;
};

/// Errors of a model, one per dwell or rotation.
struct Errors {
  std::vector<double> gravity;   ///< | |f| - 1 g | of each dwell [g]
  std::vector<double> dwell;     ///< root mean square over the gyros of w_g - w_l [rad/s]
  std::vector<double> rotation;  ///< angle between predicted and seen up after the turn [rad]
};

/// Which errors are asked for: rotations cost by far the most.
enum class Asked { gravity, all };

/// How dwells and rotations are divided: each of `repeats` shuffles them into `folds` parts. A
/// rotation belongs to the part of the dwell it starts from.
struct Division {
  int folds = 6;
  int repeats = 4;
  std::uint64_t seed = 1;
};

/// The model fitted to all dwells and rotations.
Fitted fit(const Model& model, const Evidence& evidence, Asked asked);

/// Errors on the data the model was fitted to.
Errors in_sample_errors(const Model& model, const Evidence& evidence, Asked asked);

/// Errors on dwells and rotations held out of the fit, accelerometer calibration included: root
/// mean square over the repeats for each dwell or rotation.
Errors held_out_errors(const Model& model, const Evidence& evidence, Asked asked,
                       const Division& division);

}  // namespace drift::strapdown
