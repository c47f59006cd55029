#pragma once

#include <vector>

#include "core/estimate/batch.hpp"

namespace drift::strapdown {

/// What a fit's chi-square is made of.
enum class Instrument {
  gravity,      ///< accelerometers in dwells: the length of what they read
  direction,    ///< likewise its direction, as the turns carry it from dwell to dwell
  gyros,        ///< gyros at rest
  read_in_turn  ///< accelerometers while the case turns (InTurns::read)
};

/// What is left of one of them.
struct InstrumentFit {
  Instrument of = Instrument::gravity;
  double chi2 = 0.0, dof = 0.0;

  double per_dof() const { return chi2 / dof; }
  /// That noise leaves so much and more.
  double chance() const;
  /// By which sigmas of what it alone tells are too small, if its noise is all that is wrong.
  double factor() const;
};

/// Chi-square of each instrument that a fit has rows of, one at least left after its parameters.
///
/// Gravity and gyros are summed over each dwell first: what differs from dwell to dwell is what
/// parameters are told from, and noise that only shows there is hidden in sums over rows whose
/// noise is that of neighbours. The degrees of freedom are the rows less what they determine of the
/// estimates themselves, 1 - j P j' each, j the row and P the covariance of all that is estimated,
/// attitudes too: the mean of a squared residual under the model. Nothing where a drift that walks
/// is declared, under which chi-square is another (under_walk()). filter, test, fit: of fit_batch.
std::vector<InstrumentFit> instrument_fits(const FilterSpec& filter, const MeasuredTest& test,
                                           const BatchResult& fit);

/// Of these, whether chance leaves so much in less than one right unit of 20, all of them asked.
/// By the same share is the band of a whole fit (chi_square_band()).
bool too_large(const InstrumentFit& one, const std::vector<InstrumentFit>& all);

}  // namespace drift::strapdown
