#pragma once

#include <span>

#include "analysis/inference/linear_problem.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/measured_test.hpp"

namespace drift::inference {

/// A candidate's signature: a parameter that the nominal model leaves out, per prior sigma.
struct SignatureSpec {
  std::size_t param = 0;        ///< index in TermLibrary
  Theta theta = Theta::Zero();  ///< where it is evaluated: the fit, with the nonlinear parameters
                                ///< of its term at the values to be tried
  double unit = 1.0;            ///< SI size of one prior sigma
};

/// Columns of candidates that were worked out about another fit of the same test.
struct KnownSignatures {
  const FilterSpec& filter;
  const BatchResult& fit;
  const std::vector<SignatureSpec>& specs;
  const MatX& columns;  ///< shape (rows, specs)
};

/// What a fit left, linearised: residual, nominal columns and candidate columns, rows in time
/// order. fit: of the nominal filter; its theta and psi0_l are where everything is linearised.
/// Columns of candidates come by dual numbers, many at once: of a spec's theta, the parameters of
/// its own term count. known: taken where the platform and its gyros have hardly turned since
/// (EffortLimits::turned), but for that of lambda, which goes with the misalignments themselves.
LinearProblem linear_problem(const FilterSpec& nominal, const MeasuredTest& test,
                             const BatchResult& fit, const std::vector<SignatureSpec>& specs,
                             const KnownSignatures* known = nullptr);

/// The candidate columns alone, for the rows of `tags`; shape (tags, specs).
MatX signature_columns(const FilterSpec& nominal, const MeasuredTest& test, const BatchResult& fit,
                       std::span<const SignatureSpec> specs, const std::vector<RowTag>& tags);

/// Residuals of a fit in declared sigmas, in the order of a problem's rows.
VecX residual_of(const LinearProblem& problem, const BatchResult& fit);

}  // namespace drift::inference
