#pragma once

#include "analysis/inference/noise/noise_model.hpp"
#include "core/estimate/batch.hpp"

namespace drift::strapdown {

/// What a fit says where its filter declares drifts that walk (drift_random_walk, the study's or
/// the term), which fit_batch knows nothing of: estimates, sigmas and chi-square of the rows as
/// that noise correlates them, by generalised least squares about the fit. The fit's own otherwise.
EstimateResult under_walk(const FilterSpec& filter, const MeasuredTest& test,
                          const BatchResult& fit);
/// The same under a noise that is given. fit: whole.
EstimateResult under_noise(const FilterSpec& filter, const MeasuredTest& test,
                           const BatchResult& fit, const inference::NoiseModel& noise);

}  // namespace drift::strapdown
