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
  double narrowed = 0.0;  ///< log of how much narrower the prior of lambda has become
};

/// Fits the nominal model with some of its candidates from the amplitudes that the score expects
/// and, where that may be far (frame_closure), from the other ends too; the best is kept.
///
/// The filter has the candidates' parameters active: amplitudes with the library's priors,
/// nonlinear parameters free around the grid's value (discrete ones fixed there). frame_closure
/// turns coupling eq5 and eq6 into the family that holds both.
CauseFit fit_causes(const Fitted& nominal, const MeasuredTest& test,
                    const std::vector<Choice>& choices);

}  // namespace drift::search
