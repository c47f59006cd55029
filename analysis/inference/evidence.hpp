#pragma once

#include <vector>

#include "analysis/inference/candidate.hpp"
#include "analysis/inference/noise/noise_model.hpp"

namespace drift::inference {

/// A candidate in the mean under one noise: the variant that does best.
struct Gain {
  std::size_t variant = 0;
  double ratio = 0.0;  ///< twice the log likelihood gained by its amplitudes, g' (1 + C)^-1 g
  int dof = 1;
};

/// Every candidate under one noise, without the information between candidates: cheap enough to ask
/// under several noises.
struct Evidence {
  double log_likelihood2 = 0.0;  ///< with nothing in the mean but `with`
  std::vector<Gain> gains;       ///< of every candidate
};

Evidence evidence_under(const LinearProblem& problem, const CandidateSet& set,
                        const NoiseModel& noise, const std::vector<int>& with);

}  // namespace drift::inference
