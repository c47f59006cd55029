#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/preparation/noise_card.hpp"
#include "analysis/strapdown/findings.hpp"
#include "analysis/strapdown/ladder.hpp"
#include "core/estimate/strapdown/dwells.hpp"
#include "core/physics/drift_model.hpp"
#include "core/recording/recording.hpp"

namespace drift::strapdown {

/// What is asked of the identification of a strapdown recording.
struct StrapdownOptions {
  double static_min = 2.0;   ///< shortest dwell that counts [s]
  double gravity = 9.80665;  ///< local g, to show accelerometer errors [m/s^2]
  int folds = 6;             ///< parts of the dwells and rotations, each held out once
  int repeats = 4;           ///< ways to divide them, over which held-out errors are averaged
  std::uint64_t seed = 1;    ///< of the divisions and of the bootstrap
  std::vector<Coupling> equations{Coupling::eq5, Coupling::eq6};  ///< to score; eq5, eq6 or both
};

/// The best of each equation against the other, on held-out rotations.
struct EquationContest {
  Score eq5, eq6;  ///< of the accepted models [deg]
  double z = 0.0;  ///< paired gain of eq. (5) over eq. (6), in standard errors
};

/// What a strapdown recording says of its sensors.
struct StrapdownResult {
  std::string source;
  StrapdownOptions options;
  DwellSearch search;
  preparation::NoiseCard noise;  ///< of the sensors in the dwells
  std::size_t rotations = 0, rotations_omitted = 0;
  std::vector<Trial> accelerometer_trials;     ///< in the order tried
  std::vector<Trial> gyro_trials;              ///< in the order tried
  std::vector<Final> accepted;                 ///< model of each equation
  std::vector<StrapdownParameter> parameters;  ///< of the first equation's model
  std::vector<Unobservable> unobservable;
  std::vector<EquationContest> contest;  ///< one if both equations are scored, else none
};

/// The noise of the sensors in the dwells.
preparation::NoiseCard noise_of(const Recording& recording, const DwellSearch& search);

/// Identifies the sensors of a strapdown recording: finds dwells, calibrates the accelerometers on
/// gravity, the gyro drift on dwells, scale and misalignment on the rotations between dwells, and
/// keeps of each what improves dwells and rotations that were held out of the fit.
/// Deterministic in (recording, options), whatever the number of threads.
/// InputError (recording) if the channels are not there, or if fewer than six dwells or four turns
/// between dwells are found;
/// InputError (config) if an equation is neither eq5 nor eq6.
StrapdownResult identify_strapdown(const Recording& recording, const StrapdownOptions& options);

}  // namespace drift::strapdown
