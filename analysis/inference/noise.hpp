#pragma once

#include "analysis/inference/noise_finding.hpp"
#include "analysis/inference/projector.hpp"

namespace drift::inference {

/// What the noise is, estimated with the model's parameters taken into account.
struct NoiseEstimate {
  NoiseModel model;
  std::vector<NoiseFinding> findings;
  double log_likelihood2 = 0.0;  ///< twice the restricted log likelihood, without constants
  bool driven = false;           ///< a component besides white noise was needed
};

/// Variance components by restricted maximum likelihood (parameters and attitudes marginalised with
/// their priors): white noise of accelerometers and gimbals always; angle random walk, drift random
/// walk, Markov drift and correlated accelerometer noise (time constants on a grid) are added one
/// by one while twice the log likelihood grows by more than 2.7 (the 5 % point of a variance on its
/// boundary). Logs of the sigmas are found by a quasi-Newton ascent. `with`: candidate columns that
/// are in the mean (unit priors), so that a real effect is not taken for noise.
/// Source: Patterson and Thompson 1971; discovery.md 2.1, 4.6.
/// most_added: components beside white noise and what is declared.
NoiseEstimate estimate_noise(const LinearProblem& problem, const NoiseModel& declared,
                             const std::vector<int>& with = {}, int most_added = 4);

/// White noise alone, from differences of neighbouring residuals: what is left of a residual that a
/// grossly wrong model bends. residual: in declared sigmas, not whitened. shape rows.
NoiseEstimate noise_of_differences(const LinearProblem& problem, const VecX& residual);

/// Whether the misfit is so gross that it would be taken for noise: chi-square per row thirty times
/// what the differences of neighbouring residuals allow. (Random walks of ten times the usual size
/// give three to ten.)
bool grossly_wrong(const LinearProblem& problem, const VecX& residual,
                   const NoiseEstimate& differences);

/// Lowers the weight of rows with residuals that Gaussian noise does not have (Huber's function
/// with corner 2.5) if there are significantly more of them than it allows, but not so many (2 %)
/// that the model must be wrong. Returns the number lowered. residual: whitened, about unit
/// variance.
std::size_t robust_weights(LinearProblem& problem, const VecX& residual);

}  // namespace drift::inference
