#pragma once

#include <cmath>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/detect.hpp"
#include "analysis/search/scores/log_sum.hpp"

namespace drift::search {

/// Log prior and evidence of a fitted model with the noise that was declared, and with the one
/// estimated.
struct ByNoise {
  double declared = 0.0, estimated = 0.0;
  double either() const { return log_sum(declared, estimated); }
};

inline ByNoise by_noise(const Fitted& f, const inference::NoiseModel& declared) {
  const double with_declared = 0.5 * inference::marginal_of(f.problem, declared).log_likelihood2();
  return {std::log(inference::NoisePrior::as_declared) + with_declared, f.log_evidence()};
}

/// Of the nominal model. Where effects took the place of noise, that noise is one more way in which
/// nothing but noise may be there.
inline ByNoise by_noise(const Detection& found, const inference::NoiseModel& declared) {
  ByNoise out = by_noise(found.nominal, declared);
  if (found.noise_alone) out.estimated = log_sum(out.estimated, found.noise_alone->log_evidence());
  return out;
}

}  // namespace drift::search
