#pragma once

#include "analysis/search/fitted.hpp"

namespace drift::search {

/// Where the score expects the amplitudes of the causes.
struct Expectation {
  Theta theta;
  std::vector<std::pair<std::size_t, double>> amplitude;  ///< parameter, SI
  bool lambda_among_them = false;
};

/// A model with causes, fitted.
struct CauseFit {
  FilterSpec filter;
  BatchResult fit;
  Expectation expected;
  /// Of lambda where its value is that of the profile and all but held; else 0.
  double closure_sigma = 0.0;
  double narrowed = 0.0;  ///< what the log evidence of that value has too much
  /// Twice the log by which the nominal lambda is less probable than the most probable one; of
  /// lambda among the causes.
  double loss_of_nominal = 0.0;

  /// A fit of `filter` with that sigma of lambda.
  BatchResult with_closure_sigma(BatchResult given) const;
};

/// Fits the nominal model with some of its candidates from the amplitudes that the score expects
/// and, where that may be far (frame_closure), from the other ends too; the best is kept.
///
/// The filter has the candidates' parameters active: amplitudes with the library's priors,
/// nonlinear parameters free around the grid's value (discrete ones fixed there). frame_closure
/// turns coupling eq5 and eq6 into the family that holds both. noise: under which the values of
/// lambda are weighed.
CauseFit fit_causes(const Fitted& nominal, const MeasuredTest& test,
                    const std::vector<Choice>& choices, const inference::NoiseModel& noise);

}  // namespace drift::search
