#pragma once

#include <string>

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_model.hpp"

namespace drift::inference {

/// The strongest input of free form in one equation alone.
struct LoneEffect {
  LoneInput input;
  double gain = 0.0;  ///< of twice the restricted log likelihood, against the noise it was put on
  double p_value = 1.0;  ///< of that gain, over everything that was tried
  std::string equation;  ///< "platform rate y"
};

/// Tries a free-form input (random walk, Markov processes; of several recordings a constant of
/// each: a bias, a fixed drift or a zero that another turn-on makes another) in every single
/// equation on top of a noise. What the instruments do by themselves, they do all three; an effect
/// that no candidate holds is in one of them. The p-value bounds the tries by their number (each
/// gain is 1/2 chi2_0 + 1/2 chi2_1). with: candidate columns that are in the mean.
LoneEffect strongest_lone_input(const LinearProblem& problem, const NoiseModel& noise,
                                const std::vector<int>& with = {});

}  // namespace drift::inference
