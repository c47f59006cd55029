#pragma once

#include <vector>

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/noise/noise_finding.hpp"
#include "analysis/inference/noise/noise_model.hpp"
#include "analysis/inference/thresholds.hpp"

namespace drift::inference {

/// What the noise is, estimated with the model's parameters taken into account.
struct NoiseEstimate {
  NoiseModel model;
  std::vector<NoiseFinding> findings;
  double log_likelihood2 = 0.0;  ///< twice the restricted log likelihood, without constants
  /// A component besides white noise was needed that is not declared, or more of it than is: it
  /// may have been an effect.
  bool driven = false;
  /// Read off differences of samples (noise_of_differences()): what drives was not looked for.
  bool of_differences = false;
  /// What must be added to half of that for the log evidence of this noise: its sigmas and time
  /// constants are known to their usual sizes only (Laplace's method). With the prior of which
  /// components there are (NoisePrior).
  double log_price = 0.0;
  double log_evidence() const { return 0.5 * log_likelihood2 + log_price; }
  /// Whose sigmas were estimated; covariance of their logs, then of those of their time constants.
  std::vector<const NoiseComponent*> components;
  MatX covariance;
};

/// Variance components by restricted maximum likelihood (parameters and attitudes marginalised with
/// their priors): white noise of accelerometers and gimbals always; angle random walk, drift random
/// walk, Markov drift, a drift of each caging and correlated accelerometer noise (time constants
/// first on a grid) are added one by one while twice the log likelihood grows by more than 2.7 (the
/// 5 % point of a variance on its boundary). Logs of the sigmas are found by a quasi-Newton ascent.
/// `with`: candidate columns that are in the mean (unit priors), so that a real effect is not taken
/// for noise. Source: Patterson and Thompson 1971. most_added: components beside white noise and
/// what is declared.
NoiseEstimate estimate_noise(const LinearProblem& problem, const NoiseModel& declared,
                             const std::vector<int>& with = {},
                             int most_added = NoiseLimits::most_components,
                             Cagings cagings = Cagings::alike);
/// The same where much the same is expected: from `start` if that holds for these rows as well;
/// else of its components alone, with its time constants to begin with, as long as the evidence is
/// better with them.
NoiseEstimate estimate_noise_from(const LinearProblem& problem, const NoiseModel& declared,
                                  const NoiseEstimate& start, const std::vector<int>& with);

}  // namespace drift::inference
