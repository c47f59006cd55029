#pragma once

#include "analysis/inference/noise/noise_model.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/measured_test.hpp"

namespace drift::equation {

/// A model with one parameter held at a value, everything else fitted.
struct HeldFit {
  double value = 0.0;
  /// Twice the log of p(y | value) with all other parameters and attitudes integrated over their
  /// priors (Laplace at the fit), without the constant and without the prior of the held parameter.
  /// Of lambda with misalignments of unknown size (misalignments.hpp).
  double log2 = 0.0;
  BatchResult fit;
};

/// Twice the log by which the prior of lambda holds a value less probable than those it holds most
/// probable. The library's stands for equal chances of all from one equation to the other, which a
/// fit knows by mean and sigma alone: between the two it has no say. Another one is as it is.
double loss_by_prior_of_lambda(const Prior& prior, double value);

/// near: a fit of the filter, from which this one starts with `param` put at `value`; that of
/// lambda starts from the prior too, and the better one is taken. weight: of the rows, as in
/// LinearProblem.
HeldFit fit_held(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& near,
                 std::size_t param, double value, const VecX& weight,
                 const inference::NoiseModel& noise);

}  // namespace drift::equation
