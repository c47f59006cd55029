#pragma once

#include "analysis/inference/evidence.hpp"
#include "analysis/inference/noise/lone_input.hpp"

namespace drift::inference {

/// Whether what was taken for noise of all three instruments looks like it.
struct NoiseDoubt {
  double p_candidate =
      1.0;  ///< chance that such noise alone suits one candidate as well as it does here
  double p_lone = 1.0;  ///< chance that it suits an input in one equation as well
};

/// Parametric bootstrap of non-nested hypotheses (Cox 1961; Williams 1970): recordings are drawn
/// with parameters from their prior and the noise `driven`; in each, the likelihood with `driven`
/// is compared with that of white noise and the best candidate in the mean, and with that of white
/// noise and an input in one equation (the axes of `lone` in turn). Each p is joined with the
/// chance that such noise is so small. Small p: no such noise; an effect was taken for it. with:
/// candidate columns that are in the mean anyway. white: noise without what drives the platform.
NoiseDoubt doubt(const LinearProblem& problem, const CandidateSet& set, const NoiseModel& white,
                 const NoiseModel& driven, const LoneEffect& lone, const std::vector<int>& with);

}  // namespace drift::inference
